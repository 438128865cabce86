/// Tangents for meshes that bring none.
#pragma once
#include "scene/meshes/gltf_mesh.h"
#include "shared/scene_data.h"

namespace importon {

/// Fills part.tangents as MikkTSpace defines them [Mikkelsen 2008, Simulation of Wrinkled Surfaces Revisited]: the
/// direction in which u grows on `texture` (its UV set and transform), at each corner of each triangle the mean over
/// the triangles around the vertex that hang together by edges and whose UVs are wound alike, each weighted by its
/// angle there and turned into the plane of the vertex's normal (of the triangle's, where the part has no normals); w
/// is the sign of the bitangent. Vertices between different tangents are split. Vertices of equal position, normal and
/// UV are one vertex here. A corner without usable UVs gets (0, 0, 0, 1), which stands for none.
void computeTangents(MeshPart& part, const Texture& texture);

}  // namespace importon
