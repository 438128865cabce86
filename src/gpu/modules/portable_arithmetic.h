/// Arithmetic of floats whose results Vulkan leaves no choice about.
#pragma once
#include "gpu/modules/module_blocks.h"

namespace importon::gpu {

/// Writes what Vulkan lets drivers compute as they like (dot products, lengths, mixes, products with matrices,
/// fractions unpacked from integers, …) as sums, products, quotients and roots in one order, and forbids to fuse or
/// reorder these. Sums and products are rounded correctly by every driver [Vulkan 1.2, Precision and Operation of
/// SPIR-V Instructions]. Throws std::runtime_error for functions that only the source can have in a portable form, as
/// shaders/shared/elementary.h has them.
void makePortable(ModuleBlocks& module);

}  // namespace importon::gpu
