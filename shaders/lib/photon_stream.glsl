// Random streams of photons: one sequence runs through all passes for each kind of photon and each state of its guide.
#ifndef IMPORTON_LIB_PHOTON_STREAM_GLSL
#define IMPORTON_LIB_PHOTON_STREAM_GLSL
#include "lib/path_pairs.glsl"

uvec2 photonNumber(MapSettings map, uint photon) { return longIndex(map.firstPhoton, photon); }
uint photonStream(uint purpose, MapSettings map, uint photon) {
  return streamFor(hashCombine(params.seed, purpose), photonNumber(map, photon));
}
uint photonIndex(MapSettings map, uint photon) { return photonNumber(map, photon).x; }

#endif
