#version 460
// Adds what the paths of a pass brought to the half of the film that the pass belongs to.
#extension GL_GOOGLE_include_directive : require
#include "bindings/film.glsl"
#include "lib/long_sum.glsl"
#include "lib/sampling.glsl"

layout(scalar) buffer FilmBlock { FilmPixel film[]; };
layout(push_constant, scalar) uniform Push {
  uint count;      // pixels of the tile
  uint samples;    // paths of each that are done
  uint offset;     // first film pixel of the half
  uint first;      // of each pixel's paths in this pass, or of the plan's paths, before these
  uint isPlanned;  // 1: pixels have as many paths as the sample plan says
  uint paths;      // done in all
  uint firstPixel; // of the tile in the film
} push;

// Sums are rounded alike whichever part of the image the film is: the tiles of the whole image number its pixels.
uint placeInTile(uint slot) {
  return imageIndex(imagePixel(push.firstPixel + slot)) % (kPathsAtOnce / min(params.samplesPerPass, kFewestAtOnce));
}

FilmPixel pixel;
uint random;
bool isLong;

void add(inout vec3 sum, vec3 value) {
  if (!isLong) {
    sum += value;
    return;
  }
  random = hash(random + 3u);
  sum = addRandomly(sum, value, random);
}

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  isLong = params.pass >= kNearestAdditions / (params.samplesPerPass * kMostPathsShare);
  pixel = film[push.offset + slot];
  const uint place = placeInTile(slot);
  uint first = slot, stride = push.count, count = push.samples;
  if (push.isPlanned != 0u) {
    const uint begin = max(plannedPaths(slot).x, push.first);
    const uint end = min(plannedPaths(slot + 1u).x, push.first + push.paths);
    first = begin - push.first;
    stride = 1u;
    count = end > begin ? end - begin : 0u;
  }
  for (uint k = 0u; k < count; ++k) {
    const PathLight light = pathLight[first + k * stride];
    const float gathers = light.gathers == kSawBackground ? 0.0 : float(light.gathers);
    random = hashCombine(hashCombine(params.pass, push.first + k), place);
    add(pixel.emitted, light.emitted);
    add(pixel.direct, light.direct);
    add(pixel.caustic, light.caustic);
    add(pixel.indirect, light.indirect);
    add(pixel.modulation, light.modulation);
    add(pixel.position, light.position);
    add(pixel.normal, light.normal);
    add(pixel.sharedPosition, light.sharedPosition * gathers);
    add(pixel.sharedNormal, light.sharedNormal * gathers);
    const vec3 found = light.emitted + light.direct + light.caustic, sum = found + light.indirect;
    add(pixel.square, sum * sum);
    vec3 others = vec3(pixel.gathers, pixel.foundSquare, pixel.uncovered);
    add(others, vec3(gathers, mean(found) * mean(found), light.gathers == kSawBackground ? 1.0 : 0.0));
    pixel.gathers = others.x;
    pixel.foundSquare = others.y;
    pixel.uncovered = others.z;
  }
  film[push.offset + slot] = pixel;
}
