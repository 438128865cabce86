/// PNG to RGBA, by libpng.
#pragma once
#include <span>
#include <string>

#include "scene/images/image_decode.h"

namespace importon {

[[nodiscard]] bool isPng(std::span<const unsigned char> bytes);

/// The size that the header declares. Throws SceneError at `where`.
[[nodiscard]] ImageSize readPngSize(std::span<const unsigned char> bytes, const std::string& where);

/// As decodeImage. Colour chunks (gAMA, cHRM, iCCP, sRGB) have no effect, as glTF 2.0, section 3.8.2, demands.
void decodePng(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where,
               TexelDepth depth);

}  // namespace importon
