#include "scene/images/image_decode.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "scene/images/jpeg_decode.h"
#include "scene/images/png_decode.h"

namespace importon {
namespace {

constexpr std::size_t kLongestSide = 16384;
constexpr std::size_t kMostTexels = std::size_t{1} << 27;

}  // namespace

ImageSize readImageSize(std::span<const unsigned char> bytes, const std::string& where) {
  if (bytes.empty()) throw SceneError("the image is empty", where, "save the image as PNG or JPEG again");
  if (!isPng(bytes) && !isJpeg(bytes)) {
    throw SceneError("the image is neither PNG nor JPEG", where, "save the image as PNG or JPEG");
  }
  const ImageSize size = isPng(bytes) ? readPngSize(bytes, where) : readJpegSize(bytes, where);
  const bool isAllowed = size.width > 0 && size.height > 0 && size.width <= kLongestSide &&
                         size.height <= kLongestSide && size.texels() <= kMostTexels;
  if (isAllowed) return size;
  throw SceneError(fmt::format("the image has {} x {} texels, not 1 to {} a side and {} in all at most", size.width,
                               size.height, kLongestSide, kMostTexels),
                   where, "change the size of the image");
}

void decodeImage(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where) {
  if (isPng(bytes)) {
    decodePng(bytes, texels, where);
  } else {
    decodeJpeg(bytes, texels, where);
  }
}

}  // namespace importon
