/// Texel buffers read as storage buffers, for devices whose texel buffers are too small for a scene.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/kernel_code.h"

namespace importon::gpu {

/// The module `spirv` of a kernel with each of its texel buffers declared as a read-only storage buffer at the same
/// binding: an array of items of KernelBuffer::texelWords words. What it computes is the same to the bit.
/// Throws std::logic_error where a texel buffer is none of `buffers`.
[[nodiscard]] std::vector<std::uint32_t> storageTexels(std::span<const std::uint32_t> spirv,
                                                       std::span<const KernelBuffer> buffers);

}  // namespace importon::gpu
