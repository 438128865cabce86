// Counters with the arguments of the indirect dispatches over what they count.
#ifndef IMPORTON_BINDINGS_DISPATCHES_GLSL
#define IMPORTON_BINDINGS_DISPATCHES_GLSL
#include "bindings/parameters.glsl"
#include "shared/features.h"
#include "lib/trace_queue.glsl"

layout(constant_id = kSpecDispatchWorkgroup) const uint kDispatchWorkgroup = kWorkgroupSize;
layout(scalar) buffer DispatchesBlock { DispatchArguments dispatches[]; };

void setCounter(uint counter, uint value) {
  counters[counter] = value;
  dispatches[counter].items = dispatchGroups(value, kDispatchWorkgroup);
  dispatches[counter].tiles = dispatchGroups((value + kTileSize - 1u) / kTileSize, kDispatchWorkgroup);
  dispatches[counter].rays = dispatchGroups(traceInvocations(value), kDispatchWorkgroup);
}

#endif
