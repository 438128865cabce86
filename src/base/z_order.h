/// Places of points along a curve that keeps near points together.
#pragma once
#include <cstdint>

#include "shared/glsl_compat.h"

namespace importon {

constexpr int kZOrderLevels = 10;  // of the octree that the curve runs through: three bits each

/// Place of a point along a Z-order curve through the cube of edge `extent` (m) at `origin`. [Morton 1966]
[[nodiscard]] inline std::uint32_t zOrderCode(vec3 position, vec3 origin, float extent) {
  constexpr float kCells = 1 << kZOrderLevels;
  const vec3 p = glm::clamp((position - origin) * (kCells / extent), vec3(0), vec3(kCells - 1));
  const auto spread = [](std::uint32_t x) {
    x = (x | x << 16) & 0x030000FFu;
    x = (x | x << 8) & 0x0300F00Fu;
    x = (x | x << 4) & 0x030C30C3u;
    return (x | x << 2) & 0x09249249u;
  };
  return spread(static_cast<std::uint32_t>(p.x)) | spread(static_cast<std::uint32_t>(p.y)) << 1 |
         spread(static_cast<std::uint32_t>(p.z)) << 2;
}

}  // namespace importon
