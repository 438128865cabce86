/// Rotations between rotations, with the same bits on every machine.
#pragma once
#include <glm/glm.hpp>

namespace importon {

/// sin(x), x in 0 .. pi/2, absolute error 2e-16; and atan(x), x in 0 .. 1, relative error 1e-15. From sums, products,
/// quotients and roots alone, in double: a C library's own differ from machine to machine.
[[nodiscard]] double portableSine(double x);
[[nodiscard]] double portableArctangent(double x);

/// The rotation from `a` (0) to `b` (1) at `share` of the way, at constant speed along the shorter way [Shoemake 1985,
/// Animating Rotation with Quaternion Curves, section 3.3]. Quaternions x, y, z, w of unit length.
[[nodiscard]] glm::dvec4 slerp(const glm::dvec4& a, const glm::dvec4& b, double share);

}  // namespace importon
