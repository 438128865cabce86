// One number per buffer, the same in every kernel (set 0). A kernel declares those that it uses.
#ifndef IMPORTON_SHARED_BINDINGS_H
#define IMPORTON_SHARED_BINDINGS_H
#include "glsl_compat.h"

SHARED_BEGIN

// The scene. "texel": bound as a uniform texel buffer (usamplerBuffer), which lavapipe reads much faster than
// a storage buffer at divergent addresses and which is not subject to its limit of 128 MiB.
SHARED_CONST uint kBindingBvhNodes = 0;        // texel uint4
SHARED_CONST uint kBindingBvhTriangles = 1;    // texel uint4
SHARED_CONST uint kBindingVertices = 2;        // texel uint4, two per Vertex
SHARED_CONST uint kBindingTriangles = 3;       // texel uint4, one per Triangle
SHARED_CONST uint kBindingPositions = 4;       // texel float1, three per vertex
SHARED_CONST uint kBindingMaterials = 5;       // texel uint4
SHARED_CONST uint kBindingTextures = 6;        // storage, Texture[]
SHARED_CONST uint kBindingTexels = 7;          // texel uint1, RGBA8
SHARED_CONST uint kBindingLights = 8;          // storage, Light[]
SHARED_CONST uint kBindingLightAlias = 9;      // storage, LightAlias[]
SHARED_CONST uint kBindingLightOfTriangle = 10;  // texel uint1

// Ray queues. A ray stays in its slot; a queue is a list of slots.
SHARED_CONST uint kBindingRays = 11;           // Ray[]: written as storage, read as texel uint4 through kBindingRayTexels
SHARED_CONST uint kBindingRayTexels = 12;
SHARED_CONST uint kBindingHits = 13;           // Hit[], by slot
SHARED_CONST uint kBindingQueue = 14;          // storage, uint[]: slots to trace
SHARED_CONST uint kBindingCounters = 15;       // storage, uint[]

SHARED_END
#endif
