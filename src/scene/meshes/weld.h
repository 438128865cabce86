/// Vertices at one place.
#pragma once
#include <vector>

#include "scene/meshes/gltf_mesh.h"

namespace importon {

/// For each vertex of each part the number of its place: alike for those that lie within a millionth of the size of all
/// of them. One that is not finite has a place of its own.
[[nodiscard]] std::vector<std::vector<uint>> weldVertices(const std::vector<MeshPart>& parts);

}  // namespace importon
