/// The progress line.
#pragma once
#include <string>

#include "render/render.h"

namespace importon {

/// "pass 3/64  12 s  1.2 Mphotons/s  3.4 Mrays/s  error 6.2 % of 5 %  40 s left"; leaves out what is not known (rates
/// of 0, a negative time left, no number of passes).
[[nodiscard]] std::string progressLine(const RenderProgress& progress);

}  // namespace importon
