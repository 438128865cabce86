/// The options of the image as it is seen: its size, camera, background and environment.
#pragma once
#include <vector>

#include "render/options/option_row.h"

namespace importon {

[[nodiscard]] std::vector<OptionRow> imageOptions();

}  // namespace importon
