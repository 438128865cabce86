/// WebP to RGBA8, by libwebp.
#pragma once
#include <span>
#include <string>

#include "scene/images/image_decode.h"

namespace importon {

[[nodiscard]] bool isWebp(std::span<const unsigned char> bytes);

/// The size that the header declares. Throws SceneError at `where`, also for an animation.
[[nodiscard]] ImageSize readWebpSize(std::span<const unsigned char> bytes, const std::string& where);

/// As decodeImage. Data that end early are an error.
void decodeWebp(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where);

}  // namespace importon
