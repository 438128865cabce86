/// Binary trees over the triangles of a mesh.
#pragma once
#include "accel/binary_tree.h"
#include "accel/meshes.h"

namespace importon::test {

/// In the order of the triangles.
[[nodiscard]] inline LargeVector<PrimitiveBox> boxesOf(const Mesh& mesh) {
  LargeVector<PrimitiveBox> boxes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Box box = Box::empty();
    for (int corner = 0; corner < 3; ++corner) box.include(toFloat4(mesh.vertex(t, corner)));
    setPrimitiveIndex(box, t);
    boxes.push_back(box);
  }
  return boxes;
}

[[nodiscard]] inline BinaryTree buildTree(const Mesh& mesh) {
  BuildProgress progress({}, mesh.triangles.size());
  return buildBinaryTree(boxesOf(mesh), {}, progress);
}

}  // namespace importon::test
