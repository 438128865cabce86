/// Quotients and roots that are rounded to the nearest float, for drivers that round them as they like.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace importon::gpu {

/// The module with functions of its own (shaders/lib/rounding.glsl) for each quotient and square root of floats: Vulkan
/// lets drivers be off by 2.5 units in the last place in the one and by more in the other. Throws std::logic_error for
/// words that are no module.
[[nodiscard]] std::vector<std::uint32_t> roundedDivision(std::span<const std::uint32_t> spirv);

}  // namespace importon::gpu
