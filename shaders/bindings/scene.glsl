// The scene's buffers and the accessors that lib/surface.glsl and lib/light.glsl ask for.
#ifndef IMPORTON_BINDINGS_SCENE_GLSL
#define IMPORTON_BINDINGS_SCENE_GLSL
#include "bindings/parameters.glsl"

uniform usamplerBuffer verticesTexels;
uniform usamplerBuffer trianglesTexels;
uniform usamplerBuffer materialsTexels;
uniform usamplerBuffer texturesTexels;
uniform usamplerBuffer imagesTexels;
uniform usamplerBuffer albedoTexels;
uniform usamplerBuffer instancesTexels;
uniform usamplerBuffer instanceOfPageTexels;

uvec4 vertexTexel(uint i) { return texelFetch(verticesTexels, int(i)); }
uvec4 triangleTexel(uint i) { return texelFetch(trianglesTexels, int(i)); }
uvec4 materialTexel(uint i) { return texelFetch(materialsTexels, int(i)); }
uvec4 textureTexel(uint i) { return texelFetch(texturesTexels, int(i)); }
uvec4 instanceTexel(uint i) { return texelFetch(instancesTexels, int(i)); }
uint instanceOfPage(uint i) { return texelFetch(instanceOfPageTexels, int(i)).x; }
uint albedoTexel(uint i) { return texelFetch(albedoTexels, int(i)).x; }
uint imageTexel(uint i) { return texelFetch(imagesTexels, int(i)).x; }

#include "lib/surface.glsl"

#endif
