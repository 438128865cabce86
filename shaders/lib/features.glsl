// The specialization constants of the scene and the job as GLSL constants; defaults: everything on.
#ifndef IMPORTON_LIB_FEATURES_GLSL
#define IMPORTON_LIB_FEATURES_GLSL
#include "shared/features.h"

layout(constant_id = kSpecHasTextures) const bool kHasTextures = true;
layout(constant_id = kSpecHasDeepTextures) const bool kHasDeepTextures = true;
layout(constant_id = kSpecHasNormalMaps) const bool kHasNormalMaps = true;
layout(constant_id = kSpecHasVertexColors) const bool kHasVertexColors = true;
layout(constant_id = kSpecHasReflection) const bool kHasReflection = true;
layout(constant_id = kSpecHasTransmission) const bool kHasTransmission = true;
layout(constant_id = kSpecHasMedia) const bool kHasMedia = true;
layout(constant_id = kSpecHasPanes) const bool kHasPanes = true;
layout(constant_id = kSpecHasClearcoat) const bool kHasClearcoat = true;
layout(constant_id = kSpecHasDiffuseTransmission) const bool kHasDiffuseTransmission = true;
layout(constant_id = kSpecHasSheen) const bool kHasSheen = true;
layout(constant_id = kSpecHasAnisotropy) const bool kHasAnisotropy = true;
layout(constant_id = kSpecHasIridescence) const bool kHasIridescence = true;
layout(constant_id = kSpecHasDispersion) const bool kHasDispersion = true;
layout(constant_id = kSpecHasThicknessTextures) const bool kHasThicknessTextures = true;
layout(constant_id = kSpecHasLightProfiles) const bool kHasLightProfiles = true;
layout(constant_id = kSpecHasSheets) const bool kHasSheets = true;
layout(constant_id = kSpecHasInstances) const bool kHasInstances = true;
layout(constant_id = kSpecHasTriangleLights) const bool kHasTriangleLights = true;
layout(constant_id = kSpecHasCutLights) const bool kHasCutLights = true;
layout(constant_id = kSpecHasPunctualLights) const bool kHasPunctualLights = true;
layout(constant_id = kSpecHasEnvironment) const bool kHasEnvironment = true;
layout(constant_id = kSpecHasBackground) const bool kHasBackground = false;
layout(constant_id = kSpecEyeMode) const uint kEyeMode = kEyeImage;
layout(constant_id = kSpecHasCausticMap) const bool kHasCausticMap = true;
layout(constant_id = kSpecHasGlobalMap) const bool kHasGlobalMap = true;

#endif
