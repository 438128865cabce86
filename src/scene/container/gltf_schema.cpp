#include "scene/container/gltf_schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
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
  Walk(const Json& document, const GltfSource& source, const SchemaRule& rule)
      : document_(document), source_(source), rule_(rule) {}

  void run() { descend(document_, rule_.path, Place()); }

 private:
  [[noreturn]] void fail(const std::string& what, const Place& place) const {
    throw SceneError(what, source_.at(place.pointer()), "correct the file or export it again");
  }

  void descend(const Json& value, std::string_view path, const Place& place) const {
    if (path.empty()) return check(value, place);
    const std::size_t slash = path.find('/');
    const std::string_view head = path.substr(0, slash);
    const std::string_view rest = slash == std::string_view::npos ? "" : path.substr(slash + 1);
    if (head == "*") return descendIntoAll(value, rest, place);
    if (!value.is_object()) return;
    const auto member = value.find(head);
    if (member != value.end()) return descend(*member, rest, place.at(head));
    if (rest.empty() && rule_.isRequired) fail(fmt::format("'{}' is missing", head), place);
  }

  void descendIntoAll(const Json& value, std::string_view rest, const Place& place) const {
    if (!value.is_array()) return;
    for (std::size_t i = 0; i < value.size(); ++i) descend(value[i], rest, place.at(i));
  }

  void check(const Json& value, const Place& place) const {
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

  void checkString(const Json& value, const Place& place) const {
    expect(value.is_string(), "a string", place);
    const auto& text = value.get_ref<const std::string&>();
    const std::vector<std::string>& choices = rule_.choices;
    if (choices.empty() || std::find(choices.begin(), choices.end(), text) != choices.end()) return;
    fail(fmt::format("'{}' is none of {}", printable(text), fmt::join(choices, ", ")), place);
  }

  void checkInteger(const Json& value, const Place& place) const {
    expect(value.is_number_integer(), "an integer", place);
    checkNumber(value, place);
  }

  void checkNumber(const Json& value, const Place& place) const {
    expect(value.is_number(), "a number", place);
    const auto number = value.get<double>();
    if (number >= rule_.least && number <= rule_.most) return;
    if (rule_.most == kNoLimit) fail(fmt::format("{} is less than {}", number, rule_.least), place);
    fail(fmt::format("{} lies outside {} to {}", number, rule_.least, rule_.most), place);
  }

  void checkNumbers(const Json& value, const Place& place) const {
    expect(value.is_array(), "an array of numbers", place);
    if (rule_.length != 0 && value.size() != rule_.length) {
      fail(fmt::format("expected {} numbers but found {}", rule_.length, value.size()), place);
    }
    for (std::size_t i = 0; i < value.size(); ++i) checkNumber(value[i], place.at(i));
  }

  void checkIndex(const Json& value, const Place& place) const {
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
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < size) return;
    fail(fmt::format("index {} is not among the {} {}", value.dump(), size, rule_.target), place);
  }

  void checkIndices(const Json& value, const Place& place) const {
    expect(value.is_array(), "an array of indices", place);
    for (std::size_t i = 0; i < value.size(); ++i) checkIndex(value[i], place.at(i));
  }

  void checkIndexMap(const Json& value, const Place& place) const {
    expect(value.is_object(), "an object", place);
    for (const auto& [key, index] : value.items()) checkIndex(index, place.at(std::string_view(key)));
  }

  const Json& document_;
  const GltfSource& source_;
  const SchemaRule& rule_;
};

/// Elements whose "type" is one of `types` hold an object of that name.
void checkVariants(const Json& document, const std::string& array, const std::vector<std::string>& types,
                   const GltfSource& source) {
  const Json::json_pointer place(array);
  if (!document.contains(place)) return;
  const Json& elements = document[place];
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto& type = elements[i]["type"].get_ref<const std::string&>();
    const bool needsObject = std::find(types.begin(), types.end(), type) != types.end();
    if (!needsObject || elements[i].contains(type)) continue;
    throw SceneError(fmt::format("'{}' is missing", type), source.at(fmt::format("{}/{}", array, i)),
                     "correct the file or export it again");
  }
}

}  // namespace

void checkSchema(const Json& document, const GltfSource& source) {
  if (!document.is_object()) {
    throw SceneError("the JSON is not an object", source.at(""), "correct the file or export it again");
  }
  for (const SchemaRule& rule : schemaRules()) Walk(document, source, rule).run();
  checkVariants(document, "/cameras", {"perspective", "orthographic"}, source);
  checkVariants(document, "/extensions/KHR_lights_punctual/lights", {"spot"}, source);
}

}  // namespace importon
