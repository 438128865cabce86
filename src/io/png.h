/// PNG pictures for people and web pages.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/image.h"
#include "io/tone_curve.h"

namespace importon {

/// Interleaved sRGB, row-major from the top, and opacity.
template <class Sample>
struct ShownPixels {
  int width = 0, height = 0;
  std::vector<Sample> rgb;
  std::vector<Sample> alpha = {};  // of each pixel, whose rgb is not multiplied by it; empty: all opaque
};
using PngPixels = ShownPixels<std::uint8_t>;
using DeepPngPixels = ShownPixels<std::uint16_t>;

/// The factor for light that `look` asks for. SceneError naming `where` if a channel is missing.
[[nodiscard]] float exposureOf(const Look& look, const Image& image, const std::string& where);

/// Channels R, G, B times `exposure`, the tone map, sRGB. With a channel A they are premultiplied by it, and are
/// divided by it first, as PNG has it. A pixel with a NaN is magenta, so that nobody
/// overlooks it. SceneError naming `where` if a channel is missing.
[[nodiscard]] PngPixels shownPixels(const Image& image, float exposure, ToneMap toneMap, const std::string& where);
[[nodiscard]] DeepPngPixels deepShownPixels(const Image& image, float exposure, ToneMap toneMap,
                                            const std::string& where);

/// A whole PNG file in memory. OutputError naming `where`.
[[nodiscard]] std::vector<std::byte> encodePng(const PngPixels& pixels, const std::string& where);
[[nodiscard]] std::vector<std::byte> encodePng(const DeepPngPixels& pixels, const std::string& where);

/// Renamed into place like writeExr. Throws OutputError.
void writePng(const std::filesystem::path& file, const PngPixels& pixels);
void writePng(const std::filesystem::path& file, const Image& image, const Look& look);

}  // namespace importon
