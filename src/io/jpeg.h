/// JPEG pictures.
#pragma once
#include "io/png.h"

namespace importon {

/// A whole JPEG file in memory, in sRGB, of high quality and with the colour of each pixel; opacity is left out. Throws
/// OutputError naming `where`, also for more than 65,500 pixels along a side, which JPEG does not have.
[[nodiscard]] std::vector<std::byte> encodeJpeg(const PngPixels& pixels, const std::string& where);

/// Renamed into place like writeExr. A channel A counts as light in front of black. Throws OutputError.
void writeJpeg(const std::filesystem::path& file, const Image& image, const Look& look);

}  // namespace importon
