#include "scene/container/gltf_json.h"

namespace importon {
namespace {

const nlohmann::json kNull;

}  // namespace

const nlohmann::json& member(const nlohmann::json& object, std::string_view key) {
  if (!object.is_object()) return kNull;
  const auto entry = object.find(key);
  return entry == object.end() ? kNull : *entry;
}

const nlohmann::json& element(const nlohmann::json& array, std::size_t index) {
  return array.is_array() && index < array.size() ? array[index] : kNull;
}

double numberOr(const nlohmann::json& object, std::string_view key, double otherwise) {
  const nlohmann::json& value = member(object, key);
  return value.is_number() ? value.get<double>() : otherwise;
}

float floatOr(const nlohmann::json& object, std::string_view key, float otherwise) {
  return toFloat(numberOr(object, key, otherwise));
}

int integerOr(const nlohmann::json& object, std::string_view key, int otherwise) {
  const nlohmann::json& value = member(object, key);
  if (!value.is_number_integer()) return otherwise;
  const auto number = value.get<double>();
  const bool isInt = number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max();
  return isInt ? static_cast<int>(number) : otherwise;
}

bool booleanOr(const nlohmann::json& object, std::string_view key, bool otherwise) {
  const nlohmann::json& value = member(object, key);
  return value.is_boolean() ? value.get<bool>() : otherwise;
}

std::string stringOr(const nlohmann::json& object, std::string_view key, const char* otherwise) {
  const nlohmann::json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : otherwise;
}

}  // namespace importon
