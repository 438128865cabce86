/// The options of what a render writes, and how pictures for screens look.
#pragma once
#include <vector>

#include "render/options/option_row.h"

namespace importon {

[[nodiscard]] std::vector<OptionRow> outputOptions();

}  // namespace importon
