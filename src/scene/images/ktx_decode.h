/// KTX2 to RGBA8, by libktx where it was there to build with.
#pragma once
#include <span>
#include <string>

#include "scene/images/image_decode.h"

namespace importon {

[[nodiscard]] bool isKtx(std::span<const unsigned char> bytes);

/// The size that the header declares. Throws SceneError at `where`, always in a build without libktx.
[[nodiscard]] ImageSize readKtxSize(std::span<const unsigned char> bytes, const std::string& where);

/// As decodeImage: the largest level of a two-dimensional texture, in Basis Universal or RGBA8.
void decodeKtx(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where);

}  // namespace importon
