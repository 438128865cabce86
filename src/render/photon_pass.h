/// Photons from the lights, in batches.
#pragma once
#include "render/workspace.h"

namespace importon {

/// Emits and traces photons `first` .. `first + count` of the pass; their hits are left in the workspace's records.
void tracePhotons(const Stage& stage, std::uint32_t first, std::uint32_t count, uint maxDepth);

}  // namespace importon
