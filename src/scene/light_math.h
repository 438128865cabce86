/// What sums of light are made of.
#pragma once
#include <numbers>

#include "shared/scene_data.h"

namespace importon {

inline constexpr double kPi = std::numbers::pi;

/// Mean over the channels.
[[nodiscard]] inline double meanOf(const vec3& color) {
  return (static_cast<double>(color.x) + static_cast<double>(color.y) + static_cast<double>(color.z)) / 3;
}

}  // namespace importon
