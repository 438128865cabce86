/// Feeds random bytes to the glTF loader: whatever comes, it ends with a scene or a SceneError. For libFuzzer;
/// scripts/fuzz runs it.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/error.h"
#include "scene/gltf_loader.h"

namespace {

void load(std::span<const std::byte> bytes, const importon::FileChoices& choices) {
  importon::Log log(importon::Log::Verbosity::quiet);
  try {
    (void)importon::loadGltfFromMemory(bytes, "fuzz.gltf", {}, log, {.file = choices});
  } catch (const importon::SceneError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kPoseSeconds = 0.7;  // between keys of the first inputs
  const std::span bytes(data, size);
  load(std::as_bytes(bytes), {});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.find("animations") != std::string_view::npos) load(std::as_bytes(bytes), {.at = kPoseSeconds});
  return 0;
}
