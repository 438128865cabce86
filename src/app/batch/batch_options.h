/// Many renders of one command line.
#pragma once
#include "app/command_line.h"

namespace importon {

/// Several scenes, a list, or all cameras are asked for.
[[nodiscard]] bool isBatch(const RenderCommand& command);

/// The jobs: the scenes of the command line, then those of the list, with the files that each is to write. Reads the
/// list. Throws UsageError, also where two jobs would write the same file.
[[nodiscard]] BatchCommand makeBatchCommand(const RenderCommand& common);

}  // namespace importon
