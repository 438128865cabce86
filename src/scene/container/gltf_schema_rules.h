/// What glTF 2.0 and its extensions ask of each property that the loader reads, as a table.
#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace importon {

/// objects, strings, numbers, indices: arrays of these. index: of an element of SchemaRule::target.
/// indexMap: an object whose values are indices.
enum class SchemaKind { object, objects, string, strings, boolean, integer, number, numbers, index, indices, indexMap };

/// What is done about a value that breaks its rule. none: the file is refused. With a warning, clamp: the nearest value
/// that it may have; drop: as if it were not there. Without one, as the reader of the value tells what must be told,
/// keep: as it is; empty: an empty object, where it is missing.
enum class SchemaRepair { none, clamp, drop, empty, keep };

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct SchemaRule {
  std::string path;  // keys separated by '/'; "*" stands for each element of an array
  SchemaKind kind = SchemaKind::object;
  bool isRequired = false;   // an error if the parent is there and this is not
  double least = -kNoLimit;  // integer, number, numbers
  double most = kNoLimit;
  std::size_t length = 0;              // numbers: how many; 0: any
  std::string target{};                // index, indices, indexMap: path of the array
  std::vector<std::string> choices{};  // string: what it may be; empty: anything
  SchemaRepair repair = SchemaRepair::none;
};

/// Parents stand before their children.
[[nodiscard]] const std::vector<SchemaRule>& schemaRules();

/// Of animations, which a scene at rest does not read.
[[nodiscard]] const std::vector<SchemaRule>& animationRules();

}  // namespace importon
