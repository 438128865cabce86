#include "scene/images/webp_decode.h"

#include <webp/decode.h>

#include <cstring>

#include "base/error.h"

namespace importon {

bool isWebp(std::span<const unsigned char> bytes) {
  return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
         std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

ImageSize readWebpSize(std::span<const unsigned char> bytes, const std::string& where) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) {
    throw SceneError("the header of the WebP is damaged or cut off", where, "save the image as WebP again");
  }
  if (features.has_animation != 0) {
    throw SceneError("the WebP is an animation", where, "save one picture of it as WebP");
  }
  return {static_cast<std::size_t>(features.width), static_cast<std::size_t>(features.height)};
}

void decodeWebp(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where) {
  const ImageSize size = readWebpSize(bytes, where);
  const auto* decoded = WebPDecodeRGBAInto(bytes.data(), bytes.size(), reinterpret_cast<std::uint8_t*>(texels.data()),
                                           texels.size_bytes(), static_cast<int>(4 * size.width));
  if (decoded == nullptr) {
    throw SceneError("the WebP cannot be decoded, it is damaged or cut off", where, "save the image as WebP again");
  }
}

}  // namespace importon
