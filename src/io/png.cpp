#include "io/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/error.h"
#include "io/output_file.h"
#include "io/tone_map.h"

namespace importon {

float exposureOf(const Look& look, const Image& image, const std::string& where) {
  return look.exposure ? static_cast<float>(std::exp2(*look.exposure)) : autoExposure(image, where);
}

PngPixels shownPixels(const Image& image, float exposure, ToneMap toneMap, const std::string& where) {
  const auto rgb = rgbOf(image, where);
  PngPixels pixels{image.width, image.height, std::vector<std::uint8_t>(3 * rgb[0].size())};
  const Channel* alpha = image.find("A");
  if (alpha != nullptr) pixels.alpha.resize(rgb[0].size());
  for (std::size_t i = 0; i < rgb[0].size(); ++i) {
    const float covered = alpha == nullptr ? 1.0F : std::clamp(alpha->values[i], 0.0F, 1.0F);
    const float straight = covered > 0 ? exposure / covered : exposure;
    if (alpha != nullptr) pixels.alpha[i] = static_cast<std::uint8_t>(std::lround(255 * covered));
    if (std::isnan(rgb[0][i]) || std::isnan(rgb[1][i]) || std::isnan(rgb[2][i])) {
      pixels.rgb[3 * i] = pixels.rgb[3 * i + 2] = 255;
      continue;
    }
    const std::array<float, 3> shown =
        toneMapped(toneMap, {rgb[0][i] * straight, rgb[1][i] * straight, rgb[2][i] * straight});
    for (std::size_t c = 0; c < 3; ++c)
      pixels.rgb[3 * i + c] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(shown[c])));
  }
  return pixels;
}

namespace {

/// Red, green, blue and opacity of each pixel.
std::vector<std::uint8_t> interleaved(const PngPixels& pixels) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * pixels.alpha.size());
  for (std::size_t i = 0; i < pixels.alpha.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba.push_back(pixels.rgb[3 * i + c]);
    rgba.push_back(pixels.alpha[i]);
  }
  return rgba;
}

}  // namespace

std::vector<std::byte> encodePng(const PngPixels& pixels, const std::string& where) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(pixels.width);
  description.height = static_cast<png_uint_32>(pixels.height);
  const bool isOpaque = pixels.alpha.empty();
  const std::vector<std::uint8_t> rgba = interleaved(pixels);
  description.format = isOpaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::vector<std::byte> encoded(size);
  if (png_image_write_to_memory(&description, encoded.data(), &size, 0, isOpaque ? pixels.rgb.data() : rgba.data(), 0,
                                nullptr) == 0) {
    throw OutputError(std::string("cannot encode PNG: ") + description.message, where, "check the image size");
  }
  encoded.resize(size);
  return encoded;
}

void writePng(const std::filesystem::path& file, const PngPixels& pixels) {
  OutputFile output(file);
  output.write(encodePng(pixels, file.string()));
  output.commit();
}

void writePng(const std::filesystem::path& file, const Image& image, const Look& look) {
  OutputFile output(file);  // first: an error that leaves nothing behind
  const std::string where = file.string();
  output.write(encodePng(shownPixels(image, exposureOf(look, image, where), look.toneMap, where), where));
  output.commit();
}

void writePng(const std::filesystem::path& file, const Image& image) { writePng(file, image, Look{}); }

}  // namespace importon
