/// Loops whose lanes keep what they had when they left, on drivers that run a loop on until its last lane is done.
#pragma once
#include "gpu/modules/module_blocks.h"

namespace importon::gpu {

/// Puts a phi at the end of each loop for every value that depends on what is read in the loop and is used after it;
/// what the module computes is the same. In turns in which a lane has no part, lavapipe and SwiftShader read zeros for
/// it, and overwrite with what follows from them all of its values but those of phis. So that optimisers keep these,
/// such a loop has a second way out, which is never taken. Throws std::runtime_error where a pointer leaves a loop, and
/// where the module has no gl_NumWorkGroups, which that way out asks for.
void closeLoops(ModuleBlocks& module);

}  // namespace importon::gpu
