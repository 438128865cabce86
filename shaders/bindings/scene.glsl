// The scene's buffers and the accessors that lib/surface.glsl and lib/light.glsl ask for.
#ifndef IMPORTON_BINDINGS_SCENE_GLSL
#define IMPORTON_BINDINGS_SCENE_GLSL
#include "bindings/parameters.glsl"
#include "bindings/tables.glsl"

uniform usamplerBuffer verticesTexels;
uniform usamplerBuffer trianglesTexels;
uniform usamplerBuffer imagesWords;

uvec4 vertexTexel(uint i) { return texelFetch(verticesTexels, int(i)); }
uvec4 triangleTexel(uint i) { return texelFetch(trianglesTexels, int(i)); }
uint imageTexel(uint i) { return texelFetch(imagesWords, int(i)).x; }

#include "lib/surface.glsl"

#endif
