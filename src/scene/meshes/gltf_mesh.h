/// Mesh primitives as triangle lists in object space.
#pragma once
#include <optional>
#include <vector>

#include "base/log.h"
#include "scene/container/gltf_document.h"
#include "shared/scene_data.h"

namespace importon {

/// JOINTS_n and WEIGHTS_n, each as long as the positions.
struct JointSet {
  std::vector<vec4> joints;  // indices into the joints of a skin
  std::vector<vec4> weights;
};

/// One primitive. Attributes are empty or as long as `positions`; values may be non-finite.
struct MeshPart {
  std::vector<vec3> positions;
  std::vector<vec3> normals;
  std::vector<vec4> tangents;  // w: sign of the bitangent
  std::vector<vec2> uv0;
  std::vector<vec2> uv1;
  std::vector<vec4> colors;  // linear
  std::vector<JointSet> jointSets;
  std::vector<uvec3> triangles;  // indices into the above, counter-clockwise front
  int material = -1;             // in the file; -1: the default material
  bool isOpen = false;           // its material has a volume, but it encloses none (open_surfaces.h)
};

/// Appends a copy of a vertex, with all its attributes; returns its index.
uint duplicateVertex(MeshPart& part, uint vertex);

/// The part of these triangles alone, with the vertices that they use.
[[nodiscard]] MeshPart partOf(const MeshPart& whole, const std::vector<uvec3>& triangles);

/// Reads the primitives of a mesh with its morph targets applied at `weights`. Points and lines, and primitives without
/// vertices, are passed over with a warning. Throws SceneError.
[[nodiscard]] std::vector<MeshPart> readMesh(const GltfDocument& document, std::size_t mesh,
                                             const std::vector<double>& weights, Log& log);

}  // namespace importon
