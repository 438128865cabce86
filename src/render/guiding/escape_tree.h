/// Where importance leaves a scene towards its environment: a density over rays, from rays that left. Photons from the
/// environment follow it backwards, so that those of a sky find the windows.
#pragma once
#include <span>
#include <vector>

#include "shared/render_data.h"

namespace importon {

/// A ray that left the scene: where it last met a surface, and which way it went.
using Escape = EscapeRecord;

/// A density over rays: a tree of boxes in four dimensions, with as much of what escaped in each leaf. The coordinates
/// of a ray are those of lib/environment_guide.glsl.
struct EscapeTree {
  /// As the device reads them: the centre and the number of leaves, then from 3 k on of node k, where node 1 is the
  /// root and 2 k and 2 k + 1 are below k: the least coordinates and the size of its box, and where it is split.
  std::vector<uvec4> texels;
  static constexpr double kWorthIt = 8;
  std::uint32_t leaves = 0;  // a power of two; 0: too little escaped to tell anything
  /// Share of what escaped that photons by this density, mixed with those by power, are at least kWorthIt times as many
  /// of as by power alone.
  double betterShare = 0;

  [[nodiscard]] bool isWorthIt() const { return leaves > 0 && betterShare > 0.5; }
};

/// Of the escapes of more than no weight. `discArea`: m², from which emission by power comes in each direction.
[[nodiscard]] EscapeTree buildEscapeTree(std::span<const Escape> escapes, double discArea);

}  // namespace importon
