/// JPEG to RGBA8, by libjpeg-turbo.
#pragma once
#include <span>
#include <string>

#include "scene/images/image_decode.h"

namespace importon {

[[nodiscard]] bool isJpeg(std::span<const unsigned char> bytes);

/// The size that the header declares. Throws SceneError at `where`.
[[nodiscard]] ImageSize readJpegSize(std::span<const unsigned char> bytes, const std::string& where);

/// As decodeImage, for grey and colour images. Data that end early are an error.
void decodeJpeg(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where);

}  // namespace importon
