/// The options of sequences of pictures: docs/animation.md.
#pragma once
#include <vector>

#include "render/options/option_row.h"

namespace importon {

[[nodiscard]] std::vector<OptionRow> sequenceOptions();

/// The job is of a sequence: --frames or --turntable.
[[nodiscard]] bool isSequence(const RenderJob& job);

}  // namespace importon
