#include "io/tone_curve.h"

#include <algorithm>
#include <cmath>

namespace importon {
namespace {

using Color = std::array<float, 3>;
using Rows = std::array<Color, 3>;

constexpr float kMostLight = 1e6F;  // all curves are flat there, and infinity over infinity is no number

Color times(const Rows& rows, const Color& color) {
  Color product{};
  for (std::size_t i = 0; i < 3; ++i)
    product[i] = rows[i][0] * color[0] + rows[i][1] * color[1] + rows[i][2] * color[2];
  return product;
}

template <class Function>
Color each(Color color, const Function& function) {
  for (float& value : color) value = function(value);
  return color;
}

Color clamped(const Color& color) {
  return each(color, [](float v) { return std::clamp(v, 0.0F, 1.0F); });
}

/// What Fresnel reflection adds to a base colour is taken off, then the peak is compressed and loses its saturation.
Color neutral(Color color) {
  constexpr float kF90 = 0.04F, kStart = 0.8F - kF90, kDesaturation = 0.15F, kRoom = 1 - kStart;
  const float least = std::min({color[0], color[1], color[2]});
  const float offset = least < 2 * kF90 ? least - least * least / (4 * kF90) : kF90;
  color = each(color, [&](float v) { return v - offset; });
  const float peak = std::max({color[0], color[1], color[2]});
  if (peak < kStart) return color;
  const float newPeak = 1 - kRoom * kRoom / (peak + kRoom - kStart);
  const float grey = 1 - 1 / (kDesaturation * (peak - newPeak) + 1);
  return each(color, [&](float v) { return v * newPeak / peak * (1 - grey) + newPeak * grey; });
}

Color aces(const Color& color) {
  constexpr Rows kIn{{{0.59719F, 0.35458F, 0.04823F}, {0.07600F, 0.90834F, 0.01566F}, {0.02840F, 0.13383F, 0.83777F}}};
  constexpr Rows kOut{
      {{1.60475F, -0.53108F, -0.07367F}, {-0.10208F, 1.10813F, -0.00605F}, {-0.00327F, -0.07276F, 1.07602F}}};
  return times(kOut, each(times(kIn, color), [](float v) {
                 return (v * (v + 0.0245786F) - 0.000090537F) / (v * (0.983729F * v + 0.4329510F) + 0.238081F);
               }));
}

/// Ten stops below middle grey to six and a half above it become [0, 1], then the contrast.
float agxContrast(float value) {
  constexpr float kLeast = -12.47393F, kMost = 4.026069F;  // log2 of light
  const float x = std::clamp((std::log2(std::max(value, 1e-10F)) - kLeast) / (kMost - kLeast), 0.0F, 1.0F);
  return (((((15.5F * x - 40.14F) * x + 31.96F) * x - 6.868F) * x + 0.4298F) * x + 0.1191F) * x - 0.00232F;
}

Color agx(const Color& color) {
  constexpr Rows kWide{{{0.6274F, 0.3293F, 0.0433F}, {0.0691F, 0.9195F, 0.0113F}, {0.0164F, 0.0880F, 0.8956F}}};
  constexpr Rows kNarrow{{{1.6605F, -0.5876F, -0.0728F}, {-0.1246F, 1.1329F, -0.0083F}, {-0.0182F, -0.1006F, 1.1187F}}};
  constexpr Rows kInset{{{0.856627153F, 0.0951212405F, 0.0482516061F},
                         {0.137318973F, 0.761241991F, 0.101439036F},
                         {0.111898213F, 0.0767994186F, 0.811302368F}}};
  constexpr Rows kOutset{{{1.12710058F, -0.110606643F, -0.0164939387F},
                          {-0.141329763F, 1.15782370F, -0.0164939387F},
                          {-0.141329763F, -0.110606643F, 1.25193641F}}};
  constexpr float kEncoding = 2.2F;  // of what the curve gives
  const Color encoded = times(kOutset, each(times(kInset, times(kWide, color)), agxContrast));
  return times(kNarrow, each(encoded, [](float v) { return std::pow(std::max(v, 0.0F), kEncoding); }));
}

}  // namespace

Color toneMapped(ToneMap toneMap, const Color& exposed) {
  const Color light = each(exposed, [](float v) { return v > 0 ? std::min(v, kMostLight) : 0.0F; });
  switch (toneMap) {
    case ToneMap::neutral:
      return clamped(neutral(light));
    case ToneMap::agx:
      return clamped(agx(light));
    case ToneMap::aces:
      return clamped(aces(light));
    case ToneMap::none:
      break;
  }
  return clamped(light);
}

}  // namespace importon
