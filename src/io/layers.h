/// Finds the colours in images of any program.
#pragma once
#include <string>
#include <vector>

#include "io/image.h"

namespace importon {

/// Names of the layers that hold a colour: channels NAME.R, NAME.G, NAME.B, or R, G, B themselves (the name is
/// empty then). Sorted.
[[nodiscard]] std::vector<std::string> colorLayers(const Image& image);

/// An image of channels R, G, B alone, taken from `layer`. Without a name: from R, G, B; else from the only layer
/// with a colour; else from Y, as grey. Attributes are kept. SceneError naming `where`, with what there is to
/// choose from, if that is not there or not unique.
[[nodiscard]] Image takeColor(const Image& image, const std::string& layer, const std::string& where);

}  // namespace importon
