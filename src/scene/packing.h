/// Shading attributes in 32 bits each; shaders/lib/packing.glsl is the twin of the unpacking functions.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "shared/scene_data.h"

namespace importon {

/// A unit vector on the octahedron |x| + |y| + |z| = 1, folded to the square [-1, 1]²
/// [Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit Vectors, section 3].
[[nodiscard]] inline glm::dvec2 octahedronFromDirection(const glm::dvec3& direction) {
  const glm::dvec3 onFaces = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
  if (onFaces.z >= 0) return {onFaces.x, onFaces.y};
  return {std::copysign(1.0 - std::abs(onFaces.y), onFaces.x), std::copysign(1.0 - std::abs(onFaces.x), onFaces.y)};
}

/// The inverse of octahedronFromDirection; the result has unit length.
[[nodiscard]] inline vec3 directionFromOctahedron(const vec2& square) {
  vec3 direction(square.x, square.y, 1.0f - std::abs(square.x) - std::abs(square.y));
  const float fold = std::max(-direction.z, 0.0f);
  direction.x += direction.x >= 0 ? -fold : fold;
  direction.y += direction.y >= 0 ? -fold : fold;
  return glm::normalize(direction);
}

/// The low 16 bits of a signed integer.
[[nodiscard]] inline uint lowHalf(long value) { return static_cast<uint>(value) & 0xFFFFu; }

/// Octahedral, x in the low and y in the high 16 bits, snorm16. `normal`: unit length. Never kNone.
[[nodiscard]] inline uint packNormal(const glm::dvec3& normal) {
  constexpr double kScale = 32767.0;
  const glm::dvec2 square = octahedronFromDirection(normal);
  const uint packed = lowHalf(std::lround(square.x * kScale)) | lowHalf(std::lround(square.y * kScale)) << 16;
  return packed == kNone ? 0xFFFF0000u : packed;  // (-1, -1) to (0, -1): 3e-5 rad away
}

/// Octahedral, x in the high 16 bits (snorm16), y in bits 1 to 15 (snorm15), bit 0 set if the bitangent,
/// cross(normal, tangent), has to be negated. `tangent`: unit length. Never kNone.
[[nodiscard]] inline uint packTangent(const glm::dvec3& tangent, bool isBitangentNegative) {
  const glm::dvec2 square = octahedronFromDirection(tangent);
  const uint x = lowHalf(std::lround(square.x * 32767.0));
  const uint y = static_cast<uint>(std::lround(square.y * 16383.0)) & 0x7FFFu;
  const uint packed = x << 16 | y << 1 | (isBitangentNegative ? 1u : 0u);
  return packed == kNone ? 0x0000FFFFu : packed;  // x from -1 to 0, as above
}

[[nodiscard]] inline vec3 unpackNormal(uint packed) { return directionFromOctahedron(glm::unpackSnorm2x16(packed)); }

/// Tangent in xyz, the sign of the bitangent in w.
[[nodiscard]] inline vec4 unpackTangent(uint packed) {
  const auto x = static_cast<float>(static_cast<std::int32_t>(packed) >> 16) / 32767.0f;
  const auto y = static_cast<float>(static_cast<std::int32_t>(packed << 16) >> 17) / 16383.0f;
  return vec4(directionFromOctahedron(vec2(x, y)), (packed & 1u) != 0u ? -1.0f : 1.0f);
}

/// Linear colour as half floats: red and green, blue and alpha. `color` finite and not negative; what half
/// floats cannot hold becomes their maximum.
[[nodiscard]] inline uvec2 packColor(const vec4& color) {
  const vec4 held = glm::min(color, vec4(65504.0f));
  return {glm::packHalf2x16(vec2(held.x, held.y)), glm::packHalf2x16(vec2(held.z, held.w))};
}

}  // namespace importon
