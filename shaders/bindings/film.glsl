// What paths brought to their pixels in this pass.
#ifndef IMPORTON_BINDINGS_FILM_GLSL
#define IMPORTON_BINDINGS_FILM_GLSL
#include "bindings/parameters.glsl"

layout(scalar) buffer PathLightBlock { PathLight pathLight[]; };
uniform usamplerBuffer samplePlanPairs;

/// Column and row in the whole image of the film's pixel `index`.
uvec2 imagePixel(uint index) { return params.filmCorner + uvec2(index % params.width, index / params.width); }

/// The number of a pixel of the whole image.
uint imageIndex(uvec2 pixel) { return pixel.y * params.imageSize.x + pixel.x; }

/// Of a pixel of the tile: the first of its paths among the plan's, and that path's number among all of the pixel's
/// beyond those of the mean. The plan ends with the number of its paths.
uvec2 plannedPaths(uint pixel) { return texelFetch(samplePlanPairs, int(pixel)).xy; }

/// The pixel that the plan's path `path` belongs to.
uint plannedPixel(uint path, uint pixels) {
  uint low = 0u, high = pixels;
  while (high - low > 1u) {
    const uint middle = (low + high) / 2u;
    if (plannedPaths(middle).x <= path) low = middle;
    else high = middle;
  }
  return low;
}

#endif
