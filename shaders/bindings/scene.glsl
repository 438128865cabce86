// The scene's buffers and the accessors that lib/surface.glsl and lib/light.glsl ask for.
#ifndef IMPORTON_BINDINGS_SCENE_GLSL
#define IMPORTON_BINDINGS_SCENE_GLSL
#include "bindings/parameters.glsl"

layout(binding = kBindingVertices) uniform usamplerBuffer vertexTexels;
layout(binding = kBindingTriangles) uniform usamplerBuffer triangleTexels;
layout(binding = kBindingMaterials) uniform usamplerBuffer materialTexels;
layout(binding = kBindingTextures) uniform usamplerBuffer textureTexels;
layout(binding = kBindingTexels) uniform usamplerBuffer imageTexels;
layout(binding = kBindingAlbedo) uniform usamplerBuffer albedoTexels;

uvec4 vertexTexel(uint i) { return texelFetch(vertexTexels, int(i)); }
uvec4 triangleTexel(uint i) { return texelFetch(triangleTexels, int(i)); }
uvec4 materialTexel(uint i) { return texelFetch(materialTexels, int(i)); }
uvec4 textureTexel(uint i) { return texelFetch(textureTexels, int(i)); }
uint albedoTexel(uint i) { return texelFetch(albedoTexels, int(i)).x; }
uint imageTexel(uint i) { return texelFetch(imageTexels, int(i)).x; }

#include "lib/surface.glsl"

#endif
