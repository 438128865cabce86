/// Long triangles that lie diagonally, cut into parts with boxes of their own, so that boxes are less empty.
#pragma once
#include <functional>
#include <span>

#include "accel/binary_tree.h"
#include "shared/scene_data.h"

namespace importon {

/// All areas are half of surface areas. A box's waste is its area but three times that which axis-parallel
/// boxes of no size around the triangle's points would have; triangles in axis-parallel planes have none.
struct SplitOptions {
  float leastWaste = 0.001f;    // of a box that is cut, in units of the whole scene's box
  float leastGain = 0.1f;       // of a cut, in units of the box
  float leastGainInAll = 0.1f;  // of all cuts, in units of all boxes, or there are none
  float mostParts = 0.25f;      // beyond one for each triangle, in units of triangles
};

/// Boxes of parts of triangles instead of `boxes` of whole triangles, where that pays; a triangle's index may
/// then stand with several boxes, which together hold it. Where more boxes are worth a cut than there may be
/// cuts, none is made: one each would help little. Else always the box of most waste is cut, at the coarsest
/// plane of those that halve the scene's box again and again. Those that `staysWhole` says are not cut. The same
/// whatever the number of threads. [After Ernst, Greiner 2007, Early split clipping for bounding volume hierarchies;
/// planes as Karras, Aila 2013, Fast parallel construction of high-quality bounding volume hierarchies, section 5]
[[nodiscard]] LargeVector<PrimitiveBox> splitTriangles(LargeVector<PrimitiveBox> boxes, std::span<const vec3> positions,
                                                       std::span<const Triangle> triangles, const SplitOptions& options,
                                                       const std::function<bool(const Triangle&)>& staysWhole = {});

}  // namespace importon
