/// PNG files in memory, of any bit depth and with any declared size, and JPEG files.
#pragma once
#include <cstdint>

#include "loader/gltf_builder.h"

namespace importon::test {

struct PngHeader {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  unsigned char bitDepth = 8;
  unsigned char colorType = 6;  // 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA
};

/// `samples`: rows from the top without filter bytes, 16-bit samples big-endian.
[[nodiscard]] Bytes makePng(const PngHeader& header, const Bytes& samples);

/// An RGBA8 image.
[[nodiscard]] Bytes makePng(std::uint32_t width, std::uint32_t height, const Bytes& rgba);

/// Inks: cyan, magenta, yellow and black; Adobe's files hold them turned round, as YCCK.
enum class JpegKind { baseline, progressive, arithmetic, grey, inks, adobeInks };

/// A JPEG of quality 100 from samples of RGB, grey or inks.
[[nodiscard]] Bytes makeJpeg(unsigned width, unsigned height, const Bytes& samples, JpegKind kind = JpegKind::baseline);

}  // namespace importon::test
