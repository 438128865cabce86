/// Pixels that see several surfaces.
#pragma once
#include <array>

#include "render/filter/halves.h"
#include "render/filter/surface_smoother.h"

namespace importon {

/// Gives each pixel on an edge the irradiance of up to three surfaces beside it, in the shares that its mean normal and
/// position tell, and what of `raw` differs from that significantly along the edge. `shown` holds what the surfaces
/// have. Pixels that no mixture explains stay as they are. `modulation`: by channel and pixel, means of both halves.
/// `leastSquare`: halves.h.
void mixEdges(const SurfaceSmoother& smoother, const Planes& modulation, const Halves& raw, float evenShare,
              float leastSquare, Halves& shown);

}  // namespace importon
