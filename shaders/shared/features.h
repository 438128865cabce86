// Ids of the specialization constants: what a scene needs decides which code a kernel keeps.
#ifndef IMPORTON_SHARED_FEATURES_H
#define IMPORTON_SHARED_FEATURES_H
#include "glsl_compat.h"

SHARED_BEGIN

SHARED_CONST uint kSpecWorkgroupSize = 0u;
// The traversal kernel.
SHARED_CONST uint kSpecAnyHit = 1u;
SHARED_CONST uint kSpecTraceInvocations = 2u;  // lib/trace_queue.glsl; also of what sets counters
// The scene.
SHARED_CONST uint kSpecHasTextures = 3u;
SHARED_CONST uint kSpecHasNormalMaps = 4u;
SHARED_CONST uint kSpecHasVertexColors = 5u;
SHARED_CONST uint kSpecHasReflection = 6u;  // any Fresnel or metallic reflection
SHARED_CONST uint kSpecHasTransmission = 7u;
SHARED_CONST uint kSpecHasMedia = 8u;  // absorbing solids
SHARED_CONST uint kSpecHasTriangleLights = 9u;
SHARED_CONST uint kSpecHasPunctualLights = 10u;
SHARED_CONST uint kSpecHasEnvironment = 11u;
SHARED_CONST uint kSpecHasPanes = 49u;  // smooth thin surfaces, which shadow rays pass
// Rare ones: lean modules, which all scenes without any of these get, have none of their code.
SHARED_CONST uint kSpecFirstRare = 100u;
SHARED_CONST uint kSpecHasClearcoat = 100u;
SHARED_CONST uint kSpecHasDiffuseTransmission = 101u;
SHARED_CONST uint kSpecHasSheen = 102u;
SHARED_CONST uint kSpecHasAnisotropy = 103u;
SHARED_CONST uint kSpecHasIridescence = 104u;
SHARED_CONST uint kSpecHasDispersion = 105u;
SHARED_CONST uint kSpecHasThicknessTextures = 106u;
SHARED_CONST uint kSpecHasCutLights = 107u;     // masked or blended triangles that emit
SHARED_CONST uint kSpecHasDeepTextures = 108u;  // with 16 bits a channel
SHARED_CONST uint kSpecHasLightProfiles = 110u;
SHARED_CONST uint kSpecHasSheets = 109u;     // open surfaces with a thickness, which absorb
SHARED_CONST uint kSpecHasInstances = 111u;  // meshes are placed, not all flattened
// The job.
SHARED_CONST uint kSpecEyeMode = 12u;  // kEyeImage, kEyeImportons, kEyePath
SHARED_CONST uint kSpecHasCausticMap = 13u;
SHARED_CONST uint kSpecHasGlobalMap = 14u;

SHARED_CONST uint kSpecReadsCells = 30u;         // gather rays read an irradiance map instead of photons
SHARED_CONST uint kSpecDispatchWorkgroup = 19u;  // workgroup size of the kernels dispatched indirectly
SHARED_CONST uint kSpecPixelFilter = 16u;        // kFilter*
SHARED_CONST uint kSpecHasBackground = 48u;      // the camera sees params.background where it sees no surface
SHARED_CONST uint kSpecIsGuided = 17u;           // emission follows a guide
SHARED_CONST uint kSpecPhotonKind = 18u;         // kPhotonsGlobal, kPhotonsCaustic
SHARED_CONST uint kSpecImportanceBound = 20u;    // kBound*

SHARED_CONST uint kSpecScatterIsGuided = 45u;  // photons scatter by a guide too
SHARED_CONST uint kSpecIsDirectional = 46u;    // required density knows which light glossy surfaces show

SHARED_CONST uint kBoundNone = 0u;    // required density follows the importance map
SHARED_CONST uint kBoundPixel = 1u;   // the largest density that a footprint nearby asks for
SHARED_CONST uint kBoundScreen = 2u;  // the sum of what they ask for

SHARED_CONST uint kFilterBox = 0u;
SHARED_CONST uint kFilterGaussian = 1u;
SHARED_CONST uint kFilterBlackmanHarris = 2u;

SHARED_CONST uint kPhotonsGlobal = 0u;   // paths L(S|D)*, for the global map
SHARED_CONST uint kPhotonsCaustic = 1u;  // paths LS+, for the caustic map

SHARED_CONST uint kEyeImage = 0u;      // the image, with the photon maps
SHARED_CONST uint kEyeImportons = 1u;  // records where the image would read the maps
SHARED_CONST uint kEyePath = 2u;       // unidirectional path tracing

SHARED_END
#endif
