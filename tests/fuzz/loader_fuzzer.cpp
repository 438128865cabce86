/// Feeds random bytes to the loader: whatever comes, it ends with a scene or a SceneError. libFuzzer:
///   cmake -B build/fuzz -DCMAKE_CXX_COMPILER=clang++ -DIMPORTON_BUILD_BENCHMARKS=OFF \
///         -DIMPORTON_SANITIZE=fuzzer-no-link,address,undefined
///   cmake --build build/fuzz --target importon_loader_fuzzer
///   build/fuzz/tests/fuzz/importon_loader_fuzzer -max_len=8192 CORPUS_FOLDER
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
