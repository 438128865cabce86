/// Feeds random bytes to the reader of Radiance pictures: whatever comes, it ends with an image or a SceneError. For
/// libFuzzer; scripts/fuzz runs it.
#include <cstddef>
#include <cstdint>

#include "base/error.h"
#include "io/image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)importon::decodeHdr({data, size}, "fuzz.hdr");
  } catch (const importon::SceneError&) {
  }
  return 0;
}
