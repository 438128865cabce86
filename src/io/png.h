/// PNG pictures for people and web pages.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/image.h"

namespace importon {

/// Interleaved 8-bit sRGB, row-major from the top, and opacity.
struct PngPixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::vector<std::uint8_t> alpha = {};  // of each pixel, whose rgb is not multiplied by it; empty: all opaque
};

/// Channels R, G, B times `exposure`, a filmic shoulder, sRGB. With a channel A they are premultiplied by it, and are
/// divided by it first, as PNG has it. A pixel with a NaN is magenta, so that nobody
/// overlooks it. SceneError naming `where` if a channel is missing.
[[nodiscard]] PngPixels shownPixels(const Image& image, float exposure, const std::string& where);

/// A whole PNG file in memory. OutputError naming `where`.
[[nodiscard]] std::vector<std::byte> encodePng(const PngPixels& pixels, const std::string& where);

/// Renamed into place like writeExr. Throws OutputError.
void writePng(const std::filesystem::path& file, const PngPixels& pixels);

}  // namespace importon
