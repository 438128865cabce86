// Pairs of dimensions of a path's random sequence: the first ones start it, then so many for each event.
#ifndef IMPORTON_LIB_PATH_PAIRS_GLSL
#define IMPORTON_LIB_PATH_PAIRS_GLSL
#include "lib/sequence.glsl"

const uint kPairFirst = 0u;      // pixel
const uint kPairLens = 1u;       // of a camera path: place on the lens
const uint kPairPosition = 1u;   // of a photon: choice of light and point on it
const uint kPairDirection = 2u;  // direction from the light
const uint kPairEvents = 3u;
const uint kPairsPerEvent = 3u;
// Pairs of an event
const uint kPairLobe = 0u;       // lobe and Russian roulette
const uint kPairScatter = 1u;    // direction
const uint kPairLight = 2u;      // choice of light and point on it

uint eventPair(uint flags, uint which) { return kPairEvents + kPairsPerEvent * (flags & kPathDepthMask) + which; }

#endif
