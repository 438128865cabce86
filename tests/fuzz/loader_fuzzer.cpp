/// Feeds random bytes to the glTF loader: whatever comes, it ends with a scene or a SceneError. For libFuzzer;
/// scripts/fuzz runs it.
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/error.h"
#include "scene/gltf_loader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  importon::Log log(importon::Log::Verbosity::quiet);
  try {
    (void)importon::loadGltfFromMemory(std::as_bytes(std::span(data, size)), "fuzz.gltf", {}, log);
  } catch (const importon::SceneError&) {
  }
  return 0;
}
