#include "scene/images/image_decode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "scene/images/avif_decode.h"
#include "scene/images/jpeg_decode.h"
#include "scene/images/ktx_decode.h"
#include "scene/images/png_decode.h"
#include "scene/images/webp_decode.h"

namespace importon {
namespace {

constexpr const char* kFormats = "PNG, JPEG, WebP or AVIF";

using Bytes = std::span<const unsigned char>;

struct ImageFormat {
  bool (*isIt)(Bytes);
  ImageSize (*readSize)(Bytes, const std::string& where);
  void (*decode)(Bytes, std::span<uint>, const std::string& where, TexelDepth);
};

constexpr std::array kImageFormats = {
    ImageFormat{isPng, readPngSize, decodePng},
    ImageFormat{isJpeg, readJpegSize,
                [](Bytes bytes, std::span<uint> texels, const std::string& where, TexelDepth) {
                  decodeJpeg(bytes, texels, where);
                }},
    ImageFormat{isWebp, readWebpSize,
                [](Bytes bytes, std::span<uint> texels, const std::string& where, TexelDepth) {
                  decodeWebp(bytes, texels, where);
                }},
    ImageFormat{isAvif, readAvifSize, decodeAvif},
    ImageFormat{isKtx, readKtxSize, [](Bytes bytes, std::span<uint> texels, const std::string& where, TexelDepth) {
                  decodeKtx(bytes, texels, where);
                }}};

const ImageFormat& formatOf(Bytes bytes, const std::string& where) {
  if (bytes.empty()) {
    throw SceneError("the image is empty", where, fmt::format("save the image as {} again", kFormats));
  }
  const auto* format = std::find_if(kImageFormats.begin(), kImageFormats.end(),
                                    [&](const ImageFormat& candidate) { return candidate.isIt(bytes); });
  if (format != kImageFormats.end()) return *format;
  throw SceneError(fmt::format("the image is not {}", kFormats), where, "save it as one of these");
}

}  // namespace

ImageSize readImageSize(Bytes bytes, const std::string& where) {
  const ImageSize size = formatOf(bytes, where).readSize(bytes, where);
  const bool isAllowed = size.width > 0 && size.height > 0 && size.width <= kLongestImageSide &&
                         size.height <= kLongestImageSide && size.texels() <= kMostImageTexels;
  if (isAllowed) return size;
  throw SceneError(fmt::format("the image has {} x {} texels, not 1 to {} a side and {} in all at most", size.width,
                               size.height, kLongestImageSide, kMostImageTexels),
                   where, "change the size of the image");
}

void decodeImage(Bytes bytes, std::span<uint> texels, const std::string& where, TexelDepth depth) {
  formatOf(bytes, where).decode(bytes, texels, where, depth);
}

}  // namespace importon
