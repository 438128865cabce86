/// Encoded images to RGBA. The format is told by the first bytes, not by what the file says of them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "shared/scene_data.h"

namespace importon {

inline constexpr std::uint32_t kLongestImageSide = 16384, kMostImageTexels = std::uint32_t{1} << 27;

/// What the header of an image declares.
struct ImageSize {
  std::size_t width = 0;
  std::size_t height = 0;
  bool isDeep = false;  // more than 8 bits a channel
  [[nodiscard]] std::size_t texels() const { return width * height; }
};

/// Bits of a channel that are kept. eight: RGBA8, a word a texel; sixteen: RGBA16, two words, red and green first.
enum class TexelDepth { eight, sixteen };

/// Reads the header only. Throws SceneError at `where` if the bytes are no PNG, JPEG, WebP, AVIF or, where libktx was
/// there to build with, KTX2, are cut off, or declare more than 16384 texels a side or 2^27 in all.
[[nodiscard]] ImageSize readImageSize(std::span<const unsigned char> bytes, const std::string& where);

/// Decodes to `texels`, of readImageSize(bytes).texels(), twice as many where 16 bits are kept: red in the low byte,
/// rows from the top; grey becomes RGB, no alpha becomes 1. Sixteen only if the image is deep. Throws SceneError at
/// `where`.
void decodeImage(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where,
                 TexelDepth depth = TexelDepth::eight);

}  // namespace importon
