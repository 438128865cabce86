/// The tables of directional albedo that rough materials need on the device.
#pragma once
#include <span>

#include "shared/albedo_table.h"

namespace importon {

/// kAlbedoTexels texels of two 16-bit fractions, in the order of shared/albedo_table.h.
[[nodiscard]] std::span<const uint> albedoTable();

}  // namespace importon
