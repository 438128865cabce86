#include "scene/animation/animated_value.h"

#include <algorithm>
#include <charconv>
#include <span>
#include <string_view>

#include "scene/container/gltf_json.h"
#include "scene/container/gltf_schema_rules.h"

namespace importon {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string_view>;

/// Words between slashes; a pointer starts with one, the path of a rule does not.
Words wordsOf(std::string_view path) {
  Words words;
  while (!path.empty()) {
    const std::size_t slash = path.find('/');
    words.push_back(path.substr(0, slash));
    path = slash == std::string_view::npos ? "" : path.substr(slash + 1);
  }
  return words;
}

std::optional<std::size_t> indexOf(std::string_view word) {
  std::size_t index = 0;
  const auto read = std::from_chars(word.data(), word.data() + word.size(), index);
  const bool isWhole = read.ec == std::errc() && read.ptr == word.data() + word.size();
  return isWhole && (word.size() == 1 || word.front() != '0') ? std::optional(index) : std::nullopt;
}

bool fits(std::string_view path, const Words& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t slash = path.find('/');
    const std::string_view expected = path.substr(0, slash);
    if (expected == "*" ? !indexOf(words[i]) : expected != words[i]) return false;
    const bool isLast = slash == std::string_view::npos;
    if (isLast) return i + 1 == words.size();
    path = path.substr(slash + 1);
  }
  return false;
}

/// The materials of this one are others by the time that an animation comes to them.
bool isConverted(const SchemaRule& rule) { return rule.path.find("pbrSpecularGlossiness") != std::string::npos; }

const SchemaRule* ruleOf(const Words& words) {
  for (const SchemaRule& rule : schemaRules()) {
    const bool isNumeric =
        rule.kind == SchemaKind::number || rule.kind == SchemaKind::numbers || rule.kind == SchemaKind::boolean;
    if (isNumeric && fits(rule.path, words) && !isConverted(rule)) return &rule;
  }
  return nullptr;
}

/// Of an object that need not be there, since all that it holds has defaults.
bool isImplied(std::string_view word) { return word == "pbrMetallicRoughness" || word == "spot"; }

/// What the value belongs to is there.
bool hasOwner(const Json& document, std::span<const std::string_view> owner) {
  const Json* at = &document;
  for (const std::string_view& word : owner) {
    const std::optional<std::size_t> index = indexOf(word);
    const Json& next = at->is_array() && index ? element(*at, *index) : member(*at, word);
    if (next.is_null()) return &word == &owner.back() && isImplied(word) && at->is_object();
    at = &next;
  }
  return at->is_object();
}

std::size_t targetCount(const Json& document, std::size_t mesh) {
  const Json& primitives = member(element(member(document, "meshes"), mesh), "primitives");
  const Json& targets = member(element(primitives, 0), "targets");
  return targets.is_array() ? targets.size() : 0;
}

/// Of the weights of a mesh or of a node.
std::size_t weightCount(const Json& document, const Words& words) {
  const std::size_t index = *indexOf(words[1]);
  if (words[0] == "meshes") return targetCount(document, index);
  const int mesh = integerOr(element(member(document, "nodes"), index), "mesh", -1);
  return mesh < 0 ? 0 : targetCount(document, static_cast<std::size_t>(mesh));
}

}  // namespace

std::optional<AnimatedValue> findAnimatedValue(const Json& document, const std::string& pointer) {
  if (!pointer.starts_with('/') || pointer.find('~') != std::string::npos) return std::nullopt;
  const Words words = wordsOf(std::string_view(pointer).substr(1));
  const SchemaRule* rule = ruleOf(words);
  if (rule == nullptr || !hasOwner(document, std::span(words).first(words.size() - 1))) return std::nullopt;
  AnimatedValue value{
      Json::json_pointer(pointer), AnimatedValue::Kind::number, 1, false, false, rule->least, rule->most};
  if (rule->kind == SchemaKind::boolean) value.kind = AnimatedValue::Kind::boolean;
  if (rule->kind == SchemaKind::numbers) {
    value.kind = AnimatedValue::Kind::numbers;
    value.isRotation = words.back() == "rotation";
    value.isWeights = words.back() == "weights";
    value.width = value.isWeights ? weightCount(document, words) : rule->length;
  }
  constexpr std::size_t kMostOfAnElement = 4;
  const bool hasKeys = value.isWeights ? value.width > 0 : value.width <= kMostOfAnElement && value.width > 0;
  return hasKeys ? std::optional(value) : std::nullopt;
}

void setAnimatedValue(Json& document, const AnimatedValue& value, const std::vector<double>& numbers) {
  const auto within = [&](double number) { return std::clamp(number, value.least, value.most); };
  Json& place = document[value.place];
  switch (value.kind) {
    case AnimatedValue::Kind::boolean:
      place = numbers[0] != 0;
      return;
    case AnimatedValue::Kind::number:
      place = within(numbers[0]);
      return;
    case AnimatedValue::Kind::numbers:
      place = Json::array();
      for (const double number : numbers) place.push_back(within(number));
  }
}

}  // namespace importon
