/// Images that are parts of a larger one.
#pragma once
#include <optional>
#include <string>

#include "io/image.h"

namespace importon {

/// The pixels of `width` x `height` from column `x` and row `y` of the whole image on, which `image` is, or is a part
/// of. Nothing if it does not hold all of them.
[[nodiscard]] std::optional<Image> cutOut(const Image& image, int x, int y, int width, int height);

/// Cuts two images of whole images of one size to the pixels that both hold; images of whole images of different sizes
/// stay as they are. Throws SceneError, with `where`, if there is no such pixel.
void cutToShared(Image& a, Image& b, const std::string& where);

}  // namespace importon
