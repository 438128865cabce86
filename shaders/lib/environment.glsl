// Light from far away, as a lat-long map. Its middle row and column look along -z, its right half to +x, its top
// row up, +y; radiance is interpolated between texels.
// The kernel defines `uvec4 environmentTexel(uint index)` (radiance, and the density 1/sr with which directions in
// the texel are drawn), `uvec2 environmentDrawn(uint index)` (DrawnEntry of src/scene/environment.h: a table of the
// rows, then one of the columns of each row) and `uvec2 environmentSize()` before including this file.
#ifndef IMPORTON_LIB_ENVIRONMENT_GLSL
#define IMPORTON_LIB_ENVIRONMENT_GLSL
#include "lib/sampling.glsl"
#include "shared/elementary.h"

/// Place of a direction in the map, 0 .. 1 from the left and from the top.
vec2 environmentPlace(vec3 direction) {
  const float azimuth = portableAtan(direction.x, -direction.z), polar = portableAcos(clamp(direction.y, -1.0, 1.0));
  return vec2(0.5 + azimuth / (2.0 * kPi), polar / kPi);
}

vec3 environmentRadianceAt(ivec2 texel, uvec2 size) {
  const int width = int(size.x);
  const uint x = uint((texel.x + width) % width), y = uint(clamp(texel.y, 0, int(size.y) - 1));
  return uintBitsToFloat(environmentTexel(y * size.x + x).rgb);
}

/// W/(m² sr) from a direction.
vec3 environmentRadiance(vec3 direction) {
  const uvec2 size = environmentSize();
  if (size.x * size.y == 1u) return environmentRadianceAt(ivec2(0), size);
  const vec2 p = environmentPlace(direction) * vec2(size) - 0.5;
  const ivec2 i = ivec2(floor(p));
  const vec2 f = p - floor(p);
  return mix(mix(environmentRadianceAt(i, size), environmentRadianceAt(i + ivec2(1, 0), size), f.x),
             mix(environmentRadianceAt(i + ivec2(0, 1), size), environmentRadianceAt(i + ivec2(1, 1), size), f.x), f.y);
}

/// Density with which sampleEnvironment draws a direction, 1/sr.
float pdfEnvironment(vec3 direction) {
  const uvec2 size = environmentSize();
  const uvec2 texel = min(uvec2(environmentPlace(direction) * vec2(size)), size - 1u);
  return uintBitsToFloat(environmentTexel(texel.y * size.x + texel.x).w);
}

/// Draws an entry of a table of `count` entries from `first`; what is left of u is uniform again. Entries follow u in
/// order, so that points that are even in u are so over the map; an alias table scatters them.
uint drawEntry(uint first, uint count, inout float u) {
  uint entry = environmentDrawn(first + min(uint(u * float(count)), count - 1u)).x;
  float begin = entry == 0u ? 0.0 : uintBitsToFloat(environmentDrawn(first + entry - 1u).y);
  float end = uintBitsToFloat(environmentDrawn(first + entry).y);
  while (u >= end && entry + 1u < count) {
    begin = end;
    end = uintBitsToFloat(environmentDrawn(first + ++entry).y);
  }
  u = clamp((u - begin) / (end - begin), 0.0, 0.99999994);
  return entry;
}

/// A direction by radiance: row, then column, then uniform over the texel's solid angle.
vec3 sampleEnvironment(vec2 u, out float pdf) {
  const uvec2 size = environmentSize();
  const uint row = drawEntry(0u, size.y, u.y);
  const uint column = drawEntry(size.y + row * size.x, size.x, u.x);
  pdf = uintBitsToFloat(environmentTexel(row * size.x + column).w);
  const float top = portableCos(kPi * float(row) / float(size.y));
  const float bottom = portableCos(kPi * float(row + 1u) / float(size.y));
  const float y = mix(top, bottom, u.y), r = sqrt(max(0.0, 1.0 - y * y));
  const float phi = 2.0 * kPi * ((float(column) + u.x) / float(size.x) - 0.5);
  const vec2 turn = portableCosSin(phi);
  return vec3(r * turn.y, y, -r * turn.x);
}

#endif
