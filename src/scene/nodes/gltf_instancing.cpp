#include "scene/nodes/gltf_instancing.h"

#include <fmt/format.h>

#include <optional>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/meshes/gltf_accessor.h"
#include "scene/nodes/transform.h"

namespace importon {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
constexpr std::size_t kMostInstances = std::size_t{1} << 22;

/// The values of an attribute, as many as the others have; empty if it is not there.
template <int N>
std::vector<glm::vec<N, float>> attribute(const GltfDocument& document, const nlohmann::json& attributes,
                                          const char* key, const std::string& pointer,
                                          std::optional<std::size_t>& count) {
  const int accessor = integerOr(attributes, key, -1);
  if (accessor < 0) return {};
  const std::string place = pointer + "/" + key;
  std::vector<glm::vec<N, float>> values = readFloats<N>(document, accessor, place);
  if (count && *count != values.size()) {
    throw SceneError(fmt::format("{} has {} elements but others have {}", key, values.size(), *count),
                     document.source.at(place), kExportAgain);
  }
  count = values.size();
  return values;
}

}  // namespace

std::vector<glm::dmat4> readInstances(const GltfDocument& document, std::size_t node) {
  const nlohmann::json& attributes =
      member(element(member(document.json, "nodes"), node), "extensions", kInstancing, "attributes");
  const std::string pointer = fmt::format("/nodes/{}/extensions/{}/attributes", node, kInstancing);
  std::optional<std::size_t> count;
  const auto translations = attribute<3>(document, attributes, "TRANSLATION", pointer, count);
  const auto rotations = attribute<4>(document, attributes, "ROTATION", pointer, count);
  const auto scales = attribute<3>(document, attributes, "SCALE", pointer, count);
  if (!count) return {glm::dmat4(1.0)};
  if (*count > kMostInstances) {
    throw SceneError(fmt::format("{} instances are more than {}", *count, kMostInstances), document.source.at(pointer),
                     "reduce the scene");
  }
  std::vector<glm::dmat4> instances(*count);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    Transform transform;
    if (!translations.empty()) transform.translation = translations[i];
    if (!rotations.empty()) transform.rotation = rotations[i];
    if (!scales.empty()) transform.scale = scales[i];
    instances[i] = matrixOf(transform, document.faults, pointer + "/ROTATION");
  }
  return instances;
}

}  // namespace importon
