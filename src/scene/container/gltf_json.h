/// Typed reads of JSON that has passed checkSchema: a member or what glTF says is meant when it is absent.
#pragma once
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "shared/scene_data.h"

namespace importon {

/// The nearest float; what is too large for one becomes the largest.
[[nodiscard]] inline float toFloat(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

/// The member of an object; null if there is none, or if `object` isn't one.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& object, std::string_view key);

/// The same several levels down.
template <typename... Keys>
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& object, std::string_view key, Keys... rest) {
  return member(member(object, key), rest...);
}

/// The element of an array; null if there is none, or if `array` isn't one.
[[nodiscard]] const nlohmann::json& element(const nlohmann::json& array, std::size_t index);

[[nodiscard]] double numberOr(const nlohmann::json& object, std::string_view key, double otherwise);
[[nodiscard]] float floatOr(const nlohmann::json& object, std::string_view key, float otherwise);
/// `otherwise` too when the member is no integer of this range.
[[nodiscard]] int integerOr(const nlohmann::json& object, std::string_view key, int otherwise);
[[nodiscard]] bool booleanOr(const nlohmann::json& object, std::string_view key, bool otherwise);
[[nodiscard]] std::string stringOr(const nlohmann::json& object, std::string_view key, const char* otherwise);

/// An array of N numbers.
template <int N>
[[nodiscard]] glm::vec<N, float> vectorOr(const nlohmann::json& object, std::string_view key,
                                          const glm::vec<N, float>& otherwise) {
  const nlohmann::json& array = member(object, key);
  glm::vec<N, float> result = otherwise;
  if (!array.is_array() || array.size() != N) return result;
  for (int i = 0; i < N; ++i) result[i] = toFloat(array[static_cast<std::size_t>(i)].get<double>());
  return result;
}

}  // namespace importon
