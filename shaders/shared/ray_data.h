// Rays in flight and what they hit.
#ifndef IMPORTON_SHARED_RAY_DATA_H
#define IMPORTON_SHARED_RAY_DATA_H
#include "glsl_compat.h"

SHARED_BEGIN

/// Render space. Starts at t = 0: the origin was moved off its surface by its error bound.
struct Ray {
  vec3 origin;
  float tMax;      // m, may be infinite; <= 0: nothing to trace
  vec3 direction;  // unit length
  uint id;         // keys random decisions on the way (alpha coverage)
};

/// Closest hit, or for any-hit rays: triangle == kNone means the way is free.
struct Hit {
  float t;         // m
  float u;         // barycentric weight of v1
  float v;         // barycentric weight of v2
  uint triangle;   // index into the scene's triangles; kNone: nothing hit
};

SHARED_END
#endif
