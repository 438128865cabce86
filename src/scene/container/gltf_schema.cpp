#include "scene/container/gltf_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_schema_rules.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// A place in the document: a step below a place further up. Spelt out only when something is wrong with it.
struct Place {
  const Place* parent = nullptr;
  std::string_view key;
  std::size_t element = 0;
  bool isElement = false;

  [[nodiscard]] std::string pointer() const {
    if (parent == nullptr) return "";
    return parent->pointer() + "/" + (isElement ? std::to_string(element) : pointerToken(key));
  }
  [[nodiscard]] Place at(std::string_view member) const { return {this, member, 0, false}; }
  [[nodiscard]] Place at(std::size_t index) const { return {this, "", index, true}; }
};

/// One rule on its way down the document.
class Walk {
 public:
  Walk(Json& document, const GltfSource& source, const Faults& faults, const SchemaRule& rule)
      : document_(document), source_(source), faults_(faults), rule_(rule) {}

  void run() { descend(document_, rule_.path, Place()); }

 private:
  [[noreturn]] void fail(const std::string& what, const Place& place) const {
    throw SceneError(what, source_.at(place.pointer()), kExportAgain);
  }

  void descend(Json& value, std::string_view path, const Place& place) {
    const std::size_t slash = path.find('/');
    const std::string_view head = path.substr(0, slash);
    const std::string_view rest = slash == std::string_view::npos ? "" : path.substr(slash + 1);
    if (head == "*") return descendIntoAll(value, rest, place);
    if (!value.is_object()) return;
    auto member = value.find(head);
    if (member != value.end() && member->is_null()) {
      faults_.forgive("null", place.at(head).pointer(), "the value is null", "it is taken as absent");
      value.erase(member);
      member = value.end();
    }
    if (member == value.end()) {
      if (rest.empty() && rule_.isRequired) supply(value, head, place);
      return;
    }
    if (!rest.empty()) return descend(*member, rest, place.at(head));
    isDropped_ = false;
    check(*member, place.at(head));
    if (isDropped_) value.erase(member);
  }

  void descendIntoAll(Json& value, std::string_view rest, const Place& place) {
    if (!value.is_array()) return;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (rest.empty()) {
        check(value[i], place.at(i));
      } else {
        descend(value[i], rest, place.at(i));
      }
    }
  }

  /// A member that must be there and is missing.
  void supply(Json& value, std::string_view key, const Place& place) const {
    const std::string what = fmt::format("'{}' is missing", key);
    if (rule_.repair != SchemaRepair::empty || faults_.areRefused()) fail(what, place);
    value[std::string(key)] = Json::object();
  }

  /// The end of a check that has failed: the value goes where the rule says so.
  void dropOrFail(const std::string& what, const Place& place) {
    if (rule_.repair != SchemaRepair::drop) fail(what, place);
    faults_.forgive("unknown value", place.pointer(), what, "it is taken as absent");
    isDropped_ = true;
  }

  void check(Json& value, const Place& place) {
    switch (rule_.kind) {
      case SchemaKind::object:
        return expect(value.is_object(), "an object", place);
      case SchemaKind::objects:
        return checkArray(value, place, &Json::is_object, "an array of objects");
      case SchemaKind::string:
        return checkString(value, place);
      case SchemaKind::strings:
        return checkArray(value, place, &Json::is_string, "an array of strings");
      case SchemaKind::boolean:
        return expect(value.is_boolean(), "true or false", place);
      case SchemaKind::integer:
        return checkInteger(value, place);
      case SchemaKind::number:
        return checkNumber(value, place);
      case SchemaKind::numbers:
        return checkNumbers(value, place);
      case SchemaKind::index:
        return checkIndex(value, place);
      case SchemaKind::indices:
        return checkIndices(value, place);
      case SchemaKind::indexMap:
        return checkIndexMap(value, place);
    }
  }

  void expect(bool holds, const char* what, const Place& place) const {
    if (!holds) fail(fmt::format("expected {}", what), place);
  }

  void checkArray(const Json& value, const Place& place, bool (Json::*isKind)() const noexcept,
                  const char* what) const {
    expect(value.is_array(), what, place);
    for (std::size_t i = 0; i < value.size(); ++i) {
      expect((value[i].*isKind)(), what, place.at(i));
    }
  }

  void checkString(Json& value, const Place& place) {
    expect(value.is_string(), "a string", place);
    const auto& text = value.get_ref<const std::string&>();
    const std::vector<std::string>& choices = rule_.choices;
    if (choices.empty() || std::find(choices.begin(), choices.end(), text) != choices.end()) return;
    dropOrFail(fmt::format("'{}' is none of {}", printable(text), fmt::join(choices, ", ")), place);
  }

  /// JSON knows no integers: 1.0 is one.
  static void makeInteger(Json& value) {
    constexpr double kMostExact = 9007199254740992.0;
    if (!value.is_number_float()) return;
    const auto number = value.get<double>();
    if (std::abs(number) <= kMostExact && number == std::floor(number)) value = static_cast<std::int64_t>(number);
  }

  void checkInteger(Json& value, const Place& place) {
    makeInteger(value);
    expect(value.is_number_integer(), "an integer", place);
    checkNumber(value, place);
  }

  void checkNumber(Json& value, const Place& place) {
    expect(value.is_number(), "a number", place);
    const auto number = value.get<double>();
    if (number >= rule_.least && number <= rule_.most) return;
    const std::string what = rule_.most == kNoLimit
                                 ? fmt::format("{} is less than {}", number, rule_.least)
                                 : fmt::format("{} lies outside {} to {}", number, rule_.least, rule_.most);
    if (rule_.repair == SchemaRepair::none || faults_.areRefused()) fail(what, place);
    if (rule_.repair == SchemaRepair::keep) return;
    const double clamped = std::clamp(number, rule_.least, rule_.most);
    faults_.forgive("number off its range", place.pointer(), what, fmt::format("{} is taken", clamped));
    value = clamped;
  }

  void checkNumbers(Json& value, const Place& place) {
    expect(value.is_array(), "an array of numbers", place);
    if (rule_.length != 0 && value.size() != rule_.length) {
      fail(fmt::format("expected {} numbers but found {}", rule_.length, value.size()), place);
    }
    for (std::size_t i = 0; i < value.size(); ++i) checkNumber(value[i], place.at(i));
  }

  void checkIndex(Json& value, const Place& place) {
    makeInteger(value);
    expect(value.is_number_integer(), "an index", place);
    const Json* target = &document_;
    std::string_view path = rule_.target;
    while (!path.empty() && target != nullptr) {
      const std::size_t slash = path.find('/');
      const auto member = target->find(path.substr(0, slash));
      target = member == target->end() ? nullptr : &*member;
      path = slash == std::string_view::npos ? "" : path.substr(slash + 1);
    }
    const std::size_t size = target == nullptr ? 0 : target->size();
    const bool isNegative = !value.is_number_unsigned() && value.get<std::int64_t>() < 0;
    if (!isNegative && value.get<std::uint64_t>() < size) return;
    dropOrFail(fmt::format("index {} is not among the {} {}", value.dump(), size, rule_.target), place);
  }

  void checkIndices(Json& value, const Place& place) {
    expect(value.is_array(), "an array of indices", place);
    for (std::size_t i = 0; i < value.size(); ++i) checkIndex(value[i], place.at(i));
  }

  void checkIndexMap(Json& value, const Place& place) {
    expect(value.is_object(), "an object", place);
    for (auto& [key, index] : value.items()) checkIndex(index, place.at(std::string_view(key)));
  }

  Json& document_;
  const GltfSource& source_;
  const Faults& faults_;
  const SchemaRule& rule_;
  bool isDropped_ = false;
};

/// Elements whose "type" is one of `types` hold an object of that name.
void checkVariants(const Json& document, const std::string& array, const std::vector<std::string>& types,
                   const GltfSource& source) {
  const Json::json_pointer place(array);
  if (!document.contains(place)) return;
  const Json& elements = document[place];
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!elements[i].contains("type")) continue;  // unknown, and dropped
    const auto& type = elements[i]["type"].get_ref<const std::string&>();
    const bool needsObject = std::find(types.begin(), types.end(), type) != types.end();
    if (!needsObject || elements[i].contains(type)) continue;
    throw SceneError(fmt::format("'{}' is missing", type), source.at(fmt::format("{}/{}", array, i)), kExportAgain);
  }
}

}  // namespace

void checkSchema(Json& document, const GltfSource& source, const Faults& faults) {
  if (!document.is_object()) {
    throw SceneError("the JSON is not an object", source.at(""), kExportAgain);
  }
  checkSchema(document, source, faults, schemaRules());
  checkVariants(document, "/cameras", {"perspective", "orthographic"}, source);
  checkVariants(document, "/extensions/KHR_lights_punctual/lights", {"spot"}, source);
}

void checkSchema(Json& document, const GltfSource& source, const Faults& faults, const std::vector<SchemaRule>& rules) {
  for (const SchemaRule& rule : rules) Walk(document, source, faults, rule).run();
}

}  // namespace importon
