/// Axis-aligned boxes as two vectors of four floats, which compilers keep in SIMD registers.
#pragma once
#include <cstdint>
#include <cstring>
#include <limits>

#include "shared/glsl_compat.h"

namespace importon {

/// Four floats with element-wise arithmetic (GCC and Clang vector extension).
typedef float Float4 __attribute__((vector_size(16)));

[[nodiscard]] inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
[[nodiscard]] inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

/// Elements 0 to 2 are x, y, z; element 3 is free for other use and not kept by the functions below.
struct Box {
  Float4 lo, hi;

  /// Contains nothing: the neutral element of include().
  [[nodiscard]] static Box empty() {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    return {Float4{kInf, kInf, kInf, kInf}, Float4{-kInf, -kInf, -kInf, -kInf}};
  }
  void include(const Box& other) {
    lo = min4(lo, other.lo);
    hi = max4(hi, other.hi);
  }
  void include(Float4 point) {
    lo = min4(lo, point);
    hi = max4(hi, point);
  }
  /// Half of the surface area; 0 or NaN-free for any box with points in it.
  [[nodiscard]] float halfArea() const {
    const Float4 d = hi - lo;
    return d[0] * d[1] + (d[0] + d[1]) * d[2];
  }
};

[[nodiscard]] inline Float4 toFloat4(vec3 v) { return Float4{v.x, v.y, v.z, 0.0f}; }
[[nodiscard]] inline vec3 toVec3(Float4 v) { return {v[0], v[1], v[2]}; }

}  // namespace importon
