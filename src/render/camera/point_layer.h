/// Photons and importons as the camera sees them: how many lie in each pixel.
#pragma once
#include <span>
#include <vector>

#include "shared/render_data.h"

namespace importon {

/// Points within each pixel that lie on the surface seen in its middle (near its tangent plane), times
/// `weight`. `aovs`: kAovFloats per pixel, row-major from the top; positions in render space.
[[nodiscard]] std::vector<float> countPoints(std::span<const MapPoint> points, float weight, const Parameters& camera,
                                             std::span<const float> aovs);

}  // namespace importon
