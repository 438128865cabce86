/// Loads what a GltfBuilder holds.
#pragma once
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "loader/gltf_builder.h"
#include "scene/gltf_loader.h"

namespace importon::test {

inline Scene load(const Bytes& bytes, Log& log) { return loadGltfFromMemory(asBytes(bytes), "test.glb", {}, log); }

inline Scene load(const GltfBuilder& builder) {
  Log log(Log::Verbosity::quiet);
  return load(builder.glb(), log);
}

/// The message of the SceneError that loading throws; "" if it loads.
inline std::string errorOf(const Bytes& bytes) {
  Log log(Log::Verbosity::quiet);
  try {
    (void)load(bytes, log);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}
inline std::string errorOf(const GltfBuilder& builder) { return errorOf(builder.glb()); }

/// The warnings of a load that succeeds.
inline std::vector<Warning> warningsOf(const GltfBuilder& builder) {
  Log log(Log::Verbosity::quiet);
  (void)load(builder.glb(), log);
  return log.warnings();
}

}  // namespace importon::test
