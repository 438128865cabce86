// Sums of so many floats that rounding to nearest would take the same share of each, in the end all of it.
#ifndef IMPORTON_LIB_LONG_SUM_GLSL
#define IMPORTON_LIB_LONG_SUM_GLSL
#include "lib/hash.glsl"

/// As many values may be added to the nearest float: they lose less than 2^-12 of themselves.
const uint kNearestAdditions = 4096u;

/// sum + value, rounded up or down with probabilities that give the right mean. `random`: 32 random bits.
float addRandomly(float sum, float value, uint random) {
  precise float result = sum + value;
  precise float added = result - sum;
  precise float rest =
      (sum - (result - added)) + (value - added);  // exactly what rounding left out [Knuth 1969, 4.2.2]
  if (!(abs(rest) > 0.0)) return result;
  const uint step = (rest > 0.0) == (result > 0.0) ? 1u : 0xFFFFFFFFu;  // towards the float on the other side
  const float other = uintBitsToFloat(floatBitsToUint(result) + step);
  return unitFloat(random) * abs(other - result) < abs(rest) ? other : result;
}

vec3 addRandomly(vec3 sum, vec3 value, uint random) {
  return vec3(addRandomly(sum.x, value.x, random), addRandomly(sum.y, value.y, hash(random + 1u)),
              addRandomly(sum.z, value.z, hash(random + 2u)));
}

#endif
