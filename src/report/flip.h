/// LDR-FLIP: how different two images look when one is shown after the other.
#pragma once
#include <array>
#include <vector>

#include "io/image.h"

namespace importon {

/// Linear RGB in [0, 1] as a screen shows it. A pixel with a value that isn't finite is black and marked.
struct ShownImage {
  int width = 0, height = 0;
  std::array<std::vector<float>, 3> rgb;
  std::vector<bool> isBroken;
};

/// Exposes, then filmicShoulder. SceneError naming `where` if one of R, G, B is missing.
[[nodiscard]] ShownImage toneMapped(const Image& image, float exposure, const std::string& where);

/// The FLIP map [Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"], 0 (same) to 1
/// per pixel, for the paper's default viewer: 0.7 m from a screen 0.7 m and 3840 pixels wide, 67 pixels per
/// degree. Pixels marked in either image have 1. Both images have the same size.
[[nodiscard]] std::vector<float> ldrFlipMap(const ShownImage& test, const ShownImage& reference);

/// The mean of the map.
[[nodiscard]] double ldrFlip(const ShownImage& test, const ShownImage& reference);

}  // namespace importon
