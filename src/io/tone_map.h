/// From scene light to what a screen shows. Exposure and sRGB are also those of pictures, whose curves
/// are in tone_curve.h; the shoulder is that of FLIP.
#pragma once
#include <array>
#include <span>

#include "io/image.h"

namespace importon {

/// The factor that brings the log-average luminance to middle grey, 0.18 [Reinhard et al. 2002, eq. 1 and 2].
/// Pixels below a thousandth of the mean luminance count as that much and black ones not at all, so a dark
/// background does not blow up what is lit; pixels that aren't finite don't count. 1 for a black image. Needs
/// channels R, G, B (SceneError otherwise, naming `where`).
[[nodiscard]] float autoExposure(const Image& image, const std::string& where);

/// Exposed linear value -> [0, 1], linear: the identity up to 0.5, then an exponential shoulder with the same
/// slope at the joint, 1 at infinity. NaN and negative values give 0.
[[nodiscard]] float filmicShoulder(float exposed);

/// Linear [0, 1] -> sRGB [0, 1] (IEC 61966-2-1).
[[nodiscard]] float srgbFromLinear(float linear);
/// The inverse of srgbFromLinear.
[[nodiscard]] float linearFromSrgb(float srgb);

/// The three channels R, G, B of an image; SceneError naming `where` if one is missing.
[[nodiscard]] std::array<std::span<const float>, 3> rgbOf(const Image& image, const std::string& where);

}  // namespace importon
