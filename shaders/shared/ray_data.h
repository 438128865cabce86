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
  float t;        // m
  float u;        // barycentric weight of v1
  float v;        // barycentric weight of v2
  uint triangle;  // index into the scene's triangles; kNone: nothing hit
};

// Counters that kernels/traversal/trace.comp keeps among the others; 0 at first.
SHARED_CONST uint kCounterTraceTaken = 60u;       // rays of the queue that were taken; 0 again after a dispatch
SHARED_CONST uint kCounterTraceLeft = 61u;        // invocations that are done; 0 again after a dispatch
SHARED_CONST uint kCounterTraceUnfinished = 62u;  // rays given up so far because the device ends long loops
// And kernels/lookups/map_nearest.comp.
SHARED_CONST uint kCounterLookupsUnfinished = 63u;  // lookups that the device ended
// Solids that were left out of account since a path was in too many at once: lib/media.glsl.
SHARED_CONST uint kCounterMediaForgotten = 59u;
SHARED_CONST uint kMostMediaAtOnce = 8u;

SHARED_END
#endif
