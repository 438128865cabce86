/// Selections instead of branches around a few operations.
#pragma once
#include "gpu/modules/module_blocks.h"

namespace importon::gpu {

/// Computes both sides of each branch that has nothing but a few operations on values on either, and selects: what
/// comes out is the same. CPU drivers run both sides anyway. SwiftShader takes time for a loop that doubles with
/// branches that follow one another in it, and Subzero, its compiler, goes with the square of the blocks: eye_scatter
/// took it 35 s, and takes 5. Sides that read memory or divide integers stay.
void flattenBranches(ModuleBlocks& module);

}  // namespace importon::gpu
