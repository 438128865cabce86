/// Importons: paths from the camera that carry importance.
#pragma once
#include "render/importance/importance.h"

namespace importon {

/// Traces `count` importons and leaves their records in the workspace. `global` is read for the length of gather
/// segments if `knowsImportance`.
void traceImportons(const Stage& stage, const ImportanceMap& global, std::uint32_t count, uint maxDepth,
                    bool knowsImportance);

}  // namespace importon
