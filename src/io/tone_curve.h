/// The curves that bring scene light into what a screen shows.
#pragma once
#include <array>
#include <optional>

namespace importon {

enum class ToneMap { neutral, agx, aces, none };

/// How a picture is shown.
struct Look {
  std::optional<double> exposure = {};  // EV: light counts 2^exposure times; unset: by autoExposure
  ToneMap toneMap = ToneMap::neutral;
  bool isDeep = false;  // a PNG has 16 bits a channel
};

/// Exposed linear Rec. 709 -> linear Rec. 709 of a screen, each in [0, 1]. NaN and negative values count as 0.
///
/// neutral: Khronos PBR Neutral, as glTF viewers have it. ["Khronos PBR Neutral Tone Mapper", specification, 2024]
/// agx: Sobotka's AgX over Rec. 2020, as in Blender and Filament; its contrast by a polynomial. [Wrensch, "Minimal AgX
/// Implementation", 2023; Filament's ToneMapper]
/// aces: Hill's fit of ACES' RRT and ODT for sRGB, without a factor for exposure. [Hill, BakingLab, ACES.hlsl]
/// none: clamped.
[[nodiscard]] std::array<float, 3> toneMapped(ToneMap toneMap, const std::array<float, 3>& exposed);

}  // namespace importon
