#include "io/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/error.h"
#include "io/deep_png_writer.h"
#include "io/output_file.h"
#include "io/tone_map.h"

namespace importon {

float exposureOf(const Look& look, const Image& image, const std::string& where) {
  return look.exposure ? static_cast<float>(std::exp2(*look.exposure)) : autoExposure(image, where);
}

namespace {

template <class Sample>
ShownPixels<Sample> shownAs(const Image& image, float exposure, ToneMap toneMap, const std::string& where) {
  constexpr Sample kMost = std::numeric_limits<Sample>::max();
  const auto sampleOf = [](float share) { return static_cast<Sample>(std::lround(kMost * share)); };
  const auto rgb = rgbOf(image, where);
  ShownPixels<Sample> pixels{image.width, image.height, std::vector<Sample>(3 * rgb[0].size())};
  const Channel* alpha = image.find("A");
  if (alpha != nullptr) pixels.alpha.resize(rgb[0].size());
  for (std::size_t i = 0; i < rgb[0].size(); ++i) {
    const float covered = alpha == nullptr ? 1.0F : std::clamp(alpha->values[i], 0.0F, 1.0F);
    const float straight = covered > 0 ? exposure / covered : exposure;
    if (alpha != nullptr) pixels.alpha[i] = sampleOf(covered);
    if (std::isnan(rgb[0][i]) || std::isnan(rgb[1][i]) || std::isnan(rgb[2][i])) {
      pixels.rgb[3 * i] = pixels.rgb[3 * i + 2] = kMost;
      continue;
    }
    const std::array<float, 3> shown =
        toneMapped(toneMap, {rgb[0][i] * straight, rgb[1][i] * straight, rgb[2][i] * straight});
    for (std::size_t c = 0; c < 3; ++c) pixels.rgb[3 * i + c] = sampleOf(srgbFromLinear(shown[c]));
  }
  return pixels;
}

/// Red, green, blue and, unless all are opaque, opacity of each pixel.
template <class Sample>
std::vector<Sample> interleaved(const ShownPixels<Sample>& pixels) {
  if (pixels.alpha.empty()) return pixels.rgb;
  std::vector<Sample> rgba;
  rgba.reserve(4 * pixels.alpha.size());
  for (std::size_t i = 0; i < pixels.alpha.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba.push_back(pixels.rgb[3 * i + c]);
    rgba.push_back(pixels.alpha[i]);
  }
  return rgba;
}

}  // namespace

PngPixels shownPixels(const Image& image, float exposure, ToneMap toneMap, const std::string& where) {
  return shownAs<std::uint8_t>(image, exposure, toneMap, where);
}

DeepPngPixels deepShownPixels(const Image& image, float exposure, ToneMap toneMap, const std::string& where) {
  return shownAs<std::uint16_t>(image, exposure, toneMap, where);
}

std::vector<std::byte> encodePng(const PngPixels& pixels, const std::string& where) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(pixels.width);
  description.height = static_cast<png_uint_32>(pixels.height);
  const bool isOpaque = pixels.alpha.empty();
  const std::vector<std::uint8_t> samples = interleaved(pixels);
  description.format = isOpaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::vector<std::byte> encoded(size);
  if (png_image_write_to_memory(&description, encoded.data(), &size, 0, samples.data(), 0, nullptr) == 0) {
    throw OutputError(std::string("cannot encode PNG: ") + description.message, where, "check the image size");
  }
  encoded.resize(size);
  return encoded;
}

std::vector<std::byte> encodePng(const DeepPngPixels& pixels, const std::string& where) {
  const std::vector<std::uint16_t> samples = interleaved(pixels);
  const std::size_t perRow = samples.size() / static_cast<std::size_t>(pixels.height);
  DeepPngWriter writer;
  if (!writer.write(samples, perRow, static_cast<png_uint_32>(pixels.width), static_cast<png_uint_32>(pixels.height)))
    throw OutputError("cannot encode PNG: " + writer.message(), where, "check the image size");
  return writer.bytes();
}

void writePng(const std::filesystem::path& file, const PngPixels& pixels) {
  OutputFile output(file);
  output.write(encodePng(pixels, file.string()));
  output.commit();
}

void writePng(const std::filesystem::path& file, const Image& image, const Look& look) {
  OutputFile output(file);  // first: an error that leaves nothing behind
  const std::string where = file.string();
  const float exposure = exposureOf(look, image, where);
  output.write(look.isDeep ? encodePng(deepShownPixels(image, exposure, look.toneMap, where), where)
                           : encodePng(shownPixels(image, exposure, look.toneMap, where), where));
  output.commit();
}

void writePng(const std::filesystem::path& file, const Image& image) { writePng(file, image, Look{}); }

}  // namespace importon
