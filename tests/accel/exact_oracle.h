/// What a ray's nearest hit may be, in double precision.
#pragma once
#include "accel/meshes.h"

namespace importon::test {

/// The nearest surely hit point lies at `certain` (infinity: none). Points that the ray passes within rounding
/// of an edge may count or not: the nearest such is at `possible`, which is at most `certain`.
struct NearestHit {
  double possible, certain;
};

/// Tests all triangles. `slack`: relative width of edges in barycentric weights, e.g. 1e-5.
[[nodiscard]] NearestHit nearestHit(const Mesh& mesh, const Ray& ray, double slack);

}  // namespace importon::test
