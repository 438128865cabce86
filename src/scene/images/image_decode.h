/// PNG and JPEG to RGBA8.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "shared/scene_data.h"

namespace importon {

struct ImageSize {
  std::size_t width = 0;
  std::size_t height = 0;
  [[nodiscard]] std::size_t texels() const { return width * height; }
};

/// Reads the header only. Throws SceneError at `where` if the bytes are neither PNG nor JPEG, are cut off, or
/// declare more than 16384 texels a side or 2^27 in all.
[[nodiscard]] ImageSize readImageSize(std::span<const unsigned char> bytes, const std::string& where);

/// Decodes to `texels`, of readImageSize(bytes).texels(): red in the low byte, rows from the top; 16-bit
/// channels are cut to 8, grey becomes RGB, no alpha becomes 255. Throws SceneError at `where`.
void decodeImage(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where);

}  // namespace importon
