// Which required density the footprints of importons give, and where it stands at each site.
#ifndef IMPORTON_BINDINGS_IMPORTANCE_BOUND_GLSL
#define IMPORTON_BINDINGS_IMPORTANCE_BOUND_GLSL
#include "bindings/parameters.glsl"
#include "shared/features.h"

layout(constant_id = kSpecImportanceBound) const uint kImportanceBound = kBoundPixel;
layout(scalar) buffer BoundsBlock { float bounds[]; };

#endif
