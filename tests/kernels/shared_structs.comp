// One array of each struct of the scene, for the layout test.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/ray_data.h"
#include "shared/scene_data.h"
layout(local_size_x = 1) in;

layout(set = 0, binding = 0, scalar) buffer Vertices { Vertex vertices[]; };
layout(set = 0, binding = 1, scalar) buffer Triangles { Triangle triangles[]; };
layout(set = 0, binding = 2, scalar) buffer Materials { Material materials[]; };
layout(set = 0, binding = 3, scalar) buffer Textures { Texture textures[]; };
layout(set = 0, binding = 4, scalar) buffer Lights { Light lights[]; };
layout(set = 0, binding = 5, scalar) buffer Rays { Ray rays[]; };
layout(set = 0, binding = 6, scalar) buffer Hits { Hit hits[]; };

void main() {}
