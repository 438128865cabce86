/// A module as a driver would have it after specialisation, so that the driver need not read what it then drops.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/kernel.h"

namespace importon::gpu {

/// The module `spirv` with its specialization constants taken for those of `constants`, or else for their defaults, but
/// for the workgroup size (id 0), which is left open: branches that are never taken then go, with all that only they
/// use. No arithmetic is rewritten. A module in which that cannot be done is returned as it is.
/// Throws std::logic_error where an instruction ends beyond the module.
[[nodiscard]] std::vector<std::uint32_t> specialised(std::span<const std::uint32_t> spirv,
                                                     std::span<const Specialization> constants);

}  // namespace importon::gpu
