#include "scene/images/avif_decode.h"

#include <avif/avif.h>
#include <fmt/format.h>

#include <memory>

#include "base/error.h"

namespace importon {
namespace {

class AvifReader {
 public:
  AvifReader(std::span<const unsigned char> bytes, const std::string& where) : where_(where) {
    if (!decoder_) fail(AVIF_RESULT_OUT_OF_MEMORY);
    decoder_->maxThreads = 1;  // images are decoded side by side
    decoder_->imageSizeLimit = kMostImageTexels;
    decoder_->imageDimensionLimit = kLongestImageSide;
    decoder_->ignoreExif = AVIF_TRUE;
    decoder_->ignoreXMP = AVIF_TRUE;
    decoder_->strictFlags = AVIF_STRICT_DISABLED;
    check(avifDecoderSetIOMemory(decoder_.get(), bytes.data(), bytes.size()));
    check(avifDecoderParse(decoder_.get()));
  }

  [[nodiscard]] ImageSize size() const {
    return {decoder_->image->width, decoder_->image->height, decoder_->image->depth > 8};
  }

  void read(std::span<uint> texels, TexelDepth depth) {
    const ImageSize declared = size();
    check(avifDecoderNextImage(decoder_.get()));
    if (size().width != declared.width || size().height != declared.height) fail(AVIF_RESULT_BMFF_PARSE_FAILED);
    avifRGBImage rgb;
    avifRGBImageSetDefaults(&rgb, decoder_->image);
    rgb.format = AVIF_RGB_FORMAT_RGBA;
    rgb.depth = depth == TexelDepth::sixteen ? 16 : 8;
    rgb.pixels = reinterpret_cast<std::uint8_t*>(texels.data());
    rgb.rowBytes = static_cast<std::uint32_t>(declared.width * (depth == TexelDepth::sixteen ? 8 : 4));
    check(avifImageYUVToRGB(decoder_->image, &rgb));
  }

 private:
  void check(avifResult result) const {
    if (result != AVIF_RESULT_OK) fail(result);
  }
  [[noreturn]] void fail(avifResult result) const {
    throw SceneError(fmt::format("the AVIF cannot be decoded ({})", avifResultToString(result)), where_,
                     "save the image as AVIF again");
  }

  const std::string& where_;
  std::unique_ptr<avifDecoder, void (*)(avifDecoder*)> decoder_{avifDecoderCreate(), avifDecoderDestroy};
};

}  // namespace

bool isAvif(std::span<const unsigned char> bytes) {
  const avifROData data{bytes.data(), bytes.size()};
  return avifPeekCompatibleFileType(&data) == AVIF_TRUE;
}

ImageSize readAvifSize(std::span<const unsigned char> bytes, const std::string& where) {
  return AvifReader(bytes, where).size();
}

void decodeAvif(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where,
                TexelDepth depth) {
  AvifReader(bytes, where).read(texels, depth);
}

}  // namespace importon
