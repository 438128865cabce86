/// Pictures by the names of their files.
#pragma once
#include <optional>
#include <string>

#include "io/image.h"
#include "io/tone_curve.h"

namespace importon {

enum class PictureKind { exr, hdr, png, jpeg };

/// By the extension, in whatever case: .exr, .hdr or .pic, .png, .jpg or .jpeg. None: it is another one. A name without
/// one, such as that of a device, is of the kind `plain`.
[[nodiscard]] std::optional<PictureKind> pictureKind(const std::filesystem::path& file, PictureKind plain);

/// The kind is for a screen: tone-mapped, and without layers.
[[nodiscard]] constexpr bool isForScreens(PictureKind kind) {
  return kind == PictureKind::png || kind == PictureKind::jpeg;
}

/// Writes all channels as OpenEXR, or R, G and B as the file's name says; `look` is for screens. Renamed into place at
/// the end. Throws OutputError and leaves no file then.
void writePicture(const std::filesystem::path& file, const Image& image, const Look& look, PictureKind plain);

}  // namespace importon
