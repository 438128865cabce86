#include "io/picture_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "io/jpeg.h"
#include "io/png.h"

namespace importon {

std::optional<PictureKind> pictureKind(const std::filesystem::path& file, PictureKind plain) {
  constexpr std::array<std::pair<const char*, PictureKind>, 6> kKinds{{{".exr", PictureKind::exr},
                                                                       {".hdr", PictureKind::hdr},
                                                                       {".pic", PictureKind::hdr},
                                                                       {".png", PictureKind::png},
                                                                       {".jpg", PictureKind::jpeg},
                                                                       {".jpeg", PictureKind::jpeg}}};
  std::string extension = file.extension().string();
  if (extension.empty()) return plain;
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const auto& [name, kind] : kKinds)
    if (extension == name) return kind;
  return std::nullopt;
}

void writePicture(const std::filesystem::path& file, const Image& image, const Look& look, PictureKind plain) {
  switch (pictureKind(file, plain).value_or(plain)) {
    case PictureKind::exr:
      return writeExr(file, image);
    case PictureKind::hdr:
      return writeHdr(file, image);
    case PictureKind::png:
      return writePng(file, image, look);
    case PictureKind::jpeg:
      return writeJpeg(file, image, look);
  }
}

}  // namespace importon
