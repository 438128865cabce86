#include "scene/images/texture_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace importon {
namespace {

/// IEC 61966-2-1.
double linearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::array<float, 256> makeSrgbTable() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 255.0));
  }
  return table;
}

float linear(uint byte, bool isSrgb) {
  static const std::array<float, 256> kFromSrgb = makeSrgbTable();
  return isSrgb ? kFromSrgb[byte] : static_cast<float>(byte) / 255.0f;
}

/// The texel of a row or column of `size` that holds coordinate `t`.
uint wrapped(float t, uint size, uint mode) {
  double inside = t;
  if (mode == kWrapRepeat) {
    inside -= std::floor(inside);
  } else if (mode == kWrapMirror) {
    inside -= 2.0 * std::floor(inside / 2.0);
    if (inside > 1.0) inside = 2.0 - inside;
  }
  const double texel = std::floor(inside * size);
  return static_cast<uint>(std::clamp(texel, 0.0, static_cast<double>(size - 1)));
}

}  // namespace

vec2 transformUv(const Texture& texture, const vec2& uv) {
  return {glm::dot(texture.uvRow0, vec3(uv, 1.0f)), glm::dot(texture.uvRow1, vec3(uv, 1.0f))};
}

vec4 texelAt(const Texture& texture, std::span<const uint> texels, std::size_t index) {
  const bool isSrgb = texture.isSrgb != 0;
  if (texture.isDeep != 0) {
    const std::size_t first = texture.firstTexel + 2 * index;
    const vec4 c(glm::unpackUnorm2x16(texels[first]), glm::unpackUnorm2x16(texels[first + 1]));
    return isSrgb ? vec4(linearFromSrgb(c.x), linearFromSrgb(c.y), linearFromSrgb(c.z), c.w) : c;
  }
  const uint texel = texels[texture.firstTexel + index];
  return {linear(texel & 0xFFu, isSrgb), linear(texel >> 8 & 0xFFu, isSrgb), linear(texel >> 16 & 0xFFu, isSrgb),
          linear(texel >> 24, false)};
}

vec4 nearestTexel(const Texture& texture, std::span<const uint> texels, const vec2& uv) {
  const std::size_t x = wrapped(uv.x, texture.width, texture.wrapS);
  const std::size_t y = wrapped(uv.y, texture.height, texture.wrapT);
  return texelAt(texture, texels, y * texture.width + x);
}

TriangleTexture::TriangleTexture(const Texture& texture, std::span<const uint> texels, const vec2 (&uv)[3])
    : texture_(&texture),
      texels_(texels),
      a_(transformUv(texture, uv[0])),
      e1_(transformUv(texture, uv[1]) - a_),
      e2_(transformUv(texture, uv[2]) - a_) {}

int TriangleTexture::samplesPerSide() const {
  constexpr float kMost = 64.0f;
  const vec2 size(static_cast<float>(texture_->width), static_cast<float>(texture_->height));
  const float longest = std::max({glm::length(e1_ * size), glm::length(e2_ * size), glm::length((e2_ - e1_) * size)});
  return std::isfinite(longest) ? static_cast<int>(std::clamp(std::ceil(longest), 1.0f, kMost)) : 1;
}

}  // namespace importon
