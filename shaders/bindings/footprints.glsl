// What importons' footprints ask for, read at the sites of an importance map.
#ifndef IMPORTON_BINDINGS_FOOTPRINTS_GLSL
#define IMPORTON_BINDINGS_FOOTPRINTS_GLSL
#include "bindings/parameters.glsl"
#include "lib/sampling.glsl"
#include "shared/features.h"

layout(scalar, binding = kBindingFootprints) readonly buffer FootprintsBlock { float footprints[]; };
layout(scalar, binding = kBindingBounds) writeonly buffer BoundsBlock { float bounds[]; };
layout(constant_id = kSpecImportanceBound) const uint kImportanceBound = kBoundPixel;

const float kSpokenFor = 16.0;  // importons of like footprints in the disc for which one of them speaks

/// Pixels/m².
struct AskedDensity {
  float most;  // by one path: bounds the error of a pixel
  float sum;   // by all: bounds the error of the image
};

/// Adds an importon that carries `weight` pixels, at the squared distance d2 from the site. One of the footprint density
/// g stands among g/weight of its kind per m²; none speaks beyond `limit` (squared).
void addFootprint(inout AskedDensity asked, uint record, float weight, float d2, float limit) {
  const float density = footprints[record];
  const float area = min(kSpokenFor * weight / max(density, 1e-30), kPi * limit);
  if (kPi * d2 >= area) return;
  asked.most = max(asked.most, density);
  asked.sum += weight / area;
}

#endif
