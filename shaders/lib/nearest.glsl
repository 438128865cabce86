// The distance of the M-th nearest point of a walk by histograms of squared distance, digit by digit: no list of
// neighbours, whatever M is; of a walk thinned to `stride`, that of the M/stride-th. The kernel defines
// `float countedDistance(Walk walk, vec3 normal, float radius)`: squared distance of the point at hand, or -1 if it
// does not count.
#ifndef IMPORTON_LIB_NEAREST_GLSL
#define IMPORTON_LIB_NEAREST_GLSL
#include "lib/grid_search.glsl"

// A search walks over the cells of each of its levels once, over those of one of them up to three times more, and takes
// up to kTurnsOfLevel to find and enter them.
const uint kMostTurns = 60000u;
const uint kTurnsOfLevel = 400u;
const uint kFewestTaken = 16u;  // of a thinned walk: of fewer, an estimate would be too noisy
/// Points that a walk over the cells of a level may take.
uint mostPointsOf(uint levels) {
  const uint walks = uint(bitCount(levels)) + 3u;
  return kMostTurns / walks - kTurnsOfLevel;
}

const uint kDigitBits = 5u;
const uint kDigits = 32u;
uint digitCounts[kDigits];

bool isCut = false;  // the device has ended a walk too early

/// Squared distances, as whole numbers of 1/scale m², of which the bits above `shift` are `prefix`.
struct Shell {
  float scale;
  uint prefix;
  uint shift;
  uint inner;    // points nearer than that
  uint between;  // points there
};

/// Of a walk that is thinned: how many of its points stand for `nearest`.
uint takenOf(uint nearest, Walk walk) {
  return walk.stride == 1u ? nearest : max(nearest / walk.stride, min(nearest, kFewestTaken));
}

/// All distances below `radius`.
Shell beginShell(float radius) { return Shell(1073741824.0 / (radius * radius), 0u, 30u, 0u, 0u); }

/// Narrows the shell by a digit, to where the M-th nearest point lies; false: it does not lie in the shell.
bool narrow(inout Walk walk, vec3 normal, float radius, uint nearest, inout Shell shell) {
  const uint taken = takenOf(nearest, walk);
  for (uint d = 0u; d < kDigits; ++d) digitCounts[d] = 0u;
  const uint shift = shell.shift - kDigitBits;
  restartWalk(walk);
  while (nextPoint(walk)) {
    const float d2 = countedDistance(walk, normal, radius);
    const uint key = uint(max(d2, 0.0) * shell.scale);
    if (d2 >= 0.0 && key >> shell.shift == shell.prefix) ++digitCounts[(key >> shift) & (kDigits - 1u)];
  }
  isCut = isCut || isUnfinished(walk);
  for (uint d = 0u; d < kDigits; ++d) {
    if (shell.inner + digitCounts[d] >= taken) {
      shell = Shell(shell.scale, shell.prefix << kDigitBits | d, shift, shell.inner, digitCounts[d]);
      return true;
    }
    shell.inner += digitCounts[d];
  }
  return false;
}

/// True for squared distances up to the outer limit of the shell.
bool isWithin(Shell shell, float d2) { return uint(d2 * shell.scale) >> shell.shift <= shell.prefix; }

/// The outer limit, squared, m².
float shellLimit(Shell shell) { return float(shell.prefix + 1u) * float(1u << shell.shift) / shell.scale; }

#endif
