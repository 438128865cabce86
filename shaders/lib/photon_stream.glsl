// Random streams of photons: one sequence runs through all passes for each kind of photon and each state of its guide.
#ifndef IMPORTON_LIB_PHOTON_STREAM_GLSL
#define IMPORTON_LIB_PHOTON_STREAM_GLSL
#include "lib/path_pairs.glsl"

uint photonStream(uint purpose) { return hashCombine(params.seed, purpose); }
uint photonIndex(MapSettings map, uint photon) { return map.firstPhoton + photon; }

#endif
