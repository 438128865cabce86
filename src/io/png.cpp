#include <png.h>

#include <cmath>
#include <span>
#include <vector>

#include "base/error.h"
#include "io/image.h"
#include "io/output_file.h"
#include "io/tone_map.h"

namespace importon {
namespace {

/// Interleaved 8-bit sRGB. A pixel with a NaN is magenta, so that nobody overlooks it.
std::vector<png_byte> tonemapped(const Image& image, const std::string& where) {
  const auto rgb = rgbOf(image, where);
  const float exposure = autoExposure(image, where);
  std::vector<png_byte> bytes(3 * rgb[0].size());
  for (std::size_t i = 0; i < rgb[0].size(); ++i) {
    if (std::isnan(rgb[0][i]) || std::isnan(rgb[1][i]) || std::isnan(rgb[2][i])) {
      bytes[3 * i] = bytes[3 * i + 2] = 255;
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const float shown = srgbFromLinear(filmicShoulder(rgb[c][i] * exposure));
      bytes[3 * i + c] = static_cast<png_byte>(std::lround(255 * shown));
    }
  }
  return bytes;
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image& image) {
  OutputFile output(file);
  const std::vector<png_byte> pixels = tonemapped(image, file.string());
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(image.width);
  description.height = static_cast<png_uint_32>(image.height);
  description.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::vector<std::byte> encoded(size);
  if (png_image_write_to_memory(&description, encoded.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    throw OutputError(std::string("cannot encode PNG: ") + description.message, file.string(),
                      "check the image size");
  }
  output.write(std::span(encoded).first(size));
  output.commit();
}

}  // namespace importon
