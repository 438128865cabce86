/// What an animation may move: the numbers of a file that its reader knows.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace importon {

/// A number, an array of numbers or a boolean of a document, and what it may be.
struct AnimatedValue {
  nlohmann::json::json_pointer place;
  enum class Kind { number, numbers, boolean } kind = Kind::number;
  std::size_t width = 1;  // numbers of it
  bool isRotation = false;
  bool isWeights = false;  // of morph targets: as many as there are, each in an element of its own
  double least = 0, most = 0;
};

/// The value at a JSON pointer, if a rule of the schema knows it as numbers or a boolean and what it belongs to is
/// there: an animation makes no materials, extensions or textures. The document has passed checkSchema.
[[nodiscard]] std::optional<AnimatedValue> findAnimatedValue(const nlohmann::json& document,
                                                             const std::string& pointer);

/// Writes a value, each number of it within its range.
void setAnimatedValue(nlohmann::json& document, const AnimatedValue& value, const std::vector<double>& numbers);

}  // namespace importon
