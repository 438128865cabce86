// The lights' buffers and the accessors that lib/light.glsl asks for.
#ifndef IMPORTON_BINDINGS_LIGHTS_GLSL
#define IMPORTON_BINDINGS_LIGHTS_GLSL
#include "bindings/scene.glsl"

layout(scalar, binding = kBindingLights) readonly buffer LightsBlock { Light lights[]; };
layout(scalar, binding = kBindingLightAlias) readonly buffer LightAliasBlock { LightAlias lightAlias[]; };

layout(binding = kBindingLightOfTriangle) uniform usamplerBuffer lightOfTriangleTexels;

uint lightOfTriangle(uint triangle) { return texelFetch(lightOfTriangleTexels, int(triangle)).x; }
Light lightAt(uint i) { return lights[i]; }
LightAlias lightAliasAt(uint i) { return lightAlias[i]; }

#include "lib/light.glsl"

#endif
