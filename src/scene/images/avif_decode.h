/// AVIF to RGBA, by libavif.
#pragma once
#include <span>
#include <string>

#include "scene/images/image_decode.h"

namespace importon {

[[nodiscard]] bool isAvif(std::span<const unsigned char> bytes);

/// The size that the header declares. Throws SceneError at `where`.
[[nodiscard]] ImageSize readAvifSize(std::span<const unsigned char> bytes, const std::string& where);

/// As decodeImage; of a sequence the first picture. Colour profiles have no effect, as glTF 2.0, section 3.8.2, demands
/// of other formats.
void decodeAvif(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where,
                TexelDepth depth);

}  // namespace importon
