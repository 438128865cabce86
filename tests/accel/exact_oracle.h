/// What a ray's nearest hit may be when coordinates are rounded to floats.
#pragma once
#include "accel/meshes.h"

namespace importon::test {

/// A traversal is right if it finds its hit between `possible` and `certain` (infinity: none). A triangle whose
/// edges the ray passes at more than `rounding` times its distance, on the inside, is surely hit; one that it
/// passes on the outside by less may be.
struct NearestHit {
  double possible, certain;
};

/// Tests all triangles in double precision. `rounding`: a few times 2^-24.
[[nodiscard]] NearestHit nearestHit(const Mesh& mesh, const Ray& ray, double rounding);

}  // namespace importon::test
