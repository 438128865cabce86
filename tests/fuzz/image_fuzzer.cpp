/// Feeds random bytes to the image decoders: whatever comes, they end with texels or a SceneError. For libFuzzer;
/// scripts/fuzz runs it.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "scene/images/image_decode.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostTexels = std::size_t{1} << 20;  // more only takes longer
  const std::span bytes(data, size);
  try {
    const importon::ImageSize image = importon::readImageSize(bytes, "fuzz");
    if (image.texels() > kMostTexels) return 0;
    std::vector<importon::uint> texels(image.texels());
    importon::decodeImage(bytes, texels, "fuzz");
    if (!image.isDeep) return 0;
    texels.resize(2 * image.texels());
    importon::decodeImage(bytes, texels, "fuzz", importon::TexelDepth::sixteen);
  } catch (const importon::SceneError&) {
  }
  return 0;
}
