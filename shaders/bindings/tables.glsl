// The scene's small tables, which share two buffers: a kernel may bind few.
#ifndef IMPORTON_BINDINGS_TABLES_GLSL
#define IMPORTON_BINDINGS_TABLES_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene_data.h"

layout(scalar) uniform StartsBlock { TableStarts starts; };
uniform usamplerBuffer tablesTexels;  // instances, materials, textures, lights, tree of lights
uniform usamplerBuffer listsWords;    // directional albedo, instances of pages, lights of triangles

uvec4 instanceTexel(uint i) { return texelFetch(tablesTexels, int(i)); }
uvec4 materialTexel(uint i) { return texelFetch(tablesTexels, int(starts.materials + i)); }
uvec4 textureTexel(uint i) { return texelFetch(tablesTexels, int(starts.textures + i)); }
uvec4 lightTexel(uint i) { return texelFetch(tablesTexels, int(starts.lights + i)); }
uvec4 lightTreeTexel(uint i) { return texelFetch(tablesTexels, int(starts.lightTree + i)); }

uint albedoTexel(uint i) { return texelFetch(listsWords, int(i)).x; }
uint instanceOfPage(uint i) { return texelFetch(listsWords, int(starts.instanceOfPage + i)).x; }
uint lightOfTriangle(uint triangle) { return texelFetch(listsWords, int(starts.lightOfTriangle + triangle)).x; }

#endif
