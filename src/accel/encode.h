/// Turns a wide tree into the records that the traversal kernel reads.
#pragma once
#include <array>
#include <span>

#include "accel/binary_tree.h"
#include "accel/bvh.h"
#include "accel/wide_tree.h"

namespace importon {

/// The record of a triangle: vertices turned so that v0 is opposite the longest edge.
[[nodiscard]] BvhRecord makeBvhTriangle(const std::array<vec3, 3>& vertices, std::uint32_t triangle,
                                        std::uint32_t next);

/// A node over children with these boxes, in the order of their slots.
[[nodiscard]] BvhRecord makeBvhNode(std::span<const Box> children, std::uint32_t firstChild);

/// The box that the traversal sees in a slot of a node, rounded to the nearest floats.
[[nodiscard]] Box childBox(const BvhNode& node, std::uint32_t slot);
[[nodiscard]] bool hasChild(const BvhNode& node, std::uint32_t slot);

/// Throws SceneError when there are more records than their indices can tell.
void checkBvhSize(std::size_t records);

/// Records in depth-first order: the children of a node, then the rest of its leaves' triangles, then what is
/// below each child. Throws SceneError when there are too many for their indices.
[[nodiscard]] LargeVector<BvhRecord> encodeBvh(const BinaryTree& binary, const WideTree& wide,
                                               std::span<const vec3> positions, std::span<const Triangle> triangles);

/// The same for a tree whose leaves have one primitive each: the records of their slots are given.
[[nodiscard]] LargeVector<BvhRecord> encodeBvh(const BinaryTree& binary, const WideTree& wide,
                                               std::span<const BvhRecord> primitives);

}  // namespace importon
