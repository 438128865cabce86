/// Tangents for meshes that bring none.
#pragma once
#include "scene/meshes/gltf_mesh.h"
#include "shared/scene_data.h"

namespace importon {

/// Fills part.tangents: per vertex, the direction in which u grows on `texture` (its UV set and transform), the
/// mean over the vertex's triangles weighted by area, made normal to part.normals where these exist; w is the
/// sign of the bitangent. A vertex whose triangles have no usable UVs gets (0, 0, 0, 1), which stands for none.
void computeTangents(MeshPart& part, const Texture& texture);

}  // namespace importon
