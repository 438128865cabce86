/// Image files in memory: PNG of any kind and with any declared size, JPEG, WebP and AVIF.
#pragma once
#include <array>
#include <cstdint>

#include "loader/gltf_builder.h"

namespace importon::test {

struct PngHeader {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  unsigned char bitDepth = 8;
  unsigned char colorType = 6;  // 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
  Bytes palette{};              // RGB
  Bytes transparency{};         // tRNS
};

/// `samples`: rows from the top without filter bytes, 16-bit samples big-endian.
[[nodiscard]] Bytes makePng(const PngHeader& header, const Bytes& samples);

/// An RGBA8 image.
[[nodiscard]] Bytes makePng(std::uint32_t width, std::uint32_t height, const Bytes& rgba);

/// An image of grey bytes, interlaced.
[[nodiscard]] Bytes makeInterlacedPng(std::uint32_t width, std::uint32_t height, const Bytes& grey);

/// Inks: cyan, magenta, yellow and black; Adobe's files hold them turned round, as YCCK.
enum class JpegKind { baseline, progressive, arithmetic, grey, inks, adobeInks };

/// A JPEG of quality 100 from samples of RGB, grey or inks.
[[nodiscard]] Bytes makeJpeg(unsigned width, unsigned height, const Bytes& samples, JpegKind kind = JpegKind::baseline);

/// A WebP of RGBA without loss, or with: of quality 100.
[[nodiscard]] Bytes makeWebp(int width, int height, const Bytes& rgba, bool isLossless = true);

/// An AVIF of quality 100, one square of RGBA channels of 8 to 12 bits; empty if libavif cannot encode here.
[[nodiscard]] Bytes makeAvif(std::uint32_t side, std::array<unsigned, 4> rgba, std::uint32_t bits = 8);

}  // namespace importon::test
