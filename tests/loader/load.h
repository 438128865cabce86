/// Loads what a GltfBuilder holds.
#pragma once
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "loader/gltf_builder.h"
#include "scene/gltf_loader.h"

namespace importon::test {

inline Scene load(const Bytes& bytes, Log& log, const FileChoices& choices = {}) {
  return loadGltfFromMemory(asBytes(bytes), "test.glb", {}, log, {.file = choices});
}

inline Scene load(const GltfBuilder& builder, const FileChoices& choices = {}) {
  Log log(Log::Verbosity::quiet);
  return load(builder.glb(), log, choices);
}

/// The material of a triangle after `change` of its JSON.
template <typename Change>
Material materialWith(Change change) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  change(builder.json["materials"][0]);
  return load(builder).materials.at(0);
}

inline constexpr auto kStrict = Strictness::strict;

/// The message of the SceneError that loading throws; "" if it loads.
inline std::string errorOf(const Bytes& bytes, Strictness strictness = Strictness::forgiving) {
  Log log(Log::Verbosity::quiet);
  try {
    (void)load(bytes, log, {.strictness = strictness});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}
inline std::string errorOf(const GltfBuilder& builder, Strictness strictness = Strictness::forgiving) {
  return errorOf(builder.glb(), strictness);
}

/// The warnings of a load that succeeds.
inline std::vector<Warning> warningsOf(const Bytes& bytes) {
  Log log(Log::Verbosity::quiet);
  (void)load(bytes, log);
  return log.warnings();
}
inline std::vector<Warning> warningsOf(const GltfBuilder& builder) { return warningsOf(builder.glb()); }

}  // namespace importon::test
