// The density of rays that src/render/guiding/escape_tree.h makes, and emission by it. A ray has four coordinates: two
// of its direction towards the environment, of equal solid angles, and its place across that, m from the centre.
// Include after lib/environment.glsl; a kernel that emits by it defines `uvec4 escapeTexel(uint index)`.
#ifndef IMPORTON_LIB_ENVIRONMENT_GUIDE_GLSL
#define IMPORTON_LIB_ENVIRONMENT_GUIDE_GLSL
#include "lib/sampling.glsl"
#include "shared/elementary.h"

/// 0 .. 1 by height, and around.
vec2 escapePlace(vec3 direction) {
  return vec2(0.5 + 0.5 * direction.y, clamp(0.5 + portableAtan(direction.x, -direction.z) / (2.0 * kPi), 0.0, 1.0));
}

vec3 escapeDirection(vec2 place) {
  const float y = 2.0 * place.x - 1.0, r = sqrt(max(0.0, 1.0 - y * y));
  const vec2 turn = portableCosSin(2.0 * kPi * (place.y - 0.5));
  return vec3(r * turn.y, y, -r * turn.x);
}

#endif
