// How many invocations trace the rays of a queue.
#ifndef IMPORTON_LIB_TRACE_QUEUE_GLSL
#define IMPORTON_LIB_TRACE_QUEUE_GLSL
#include "shared/features.h"

/// What keeps the device busy: shorter queues are spread over as many invocations as they have rays.
layout(constant_id = kSpecTraceInvocations) const uint kTraceInvocations = 2048u;

const uint kRaysPerInvocation = 32u;  // of a long queue

uint traceInvocations(uint rays) {
  return max((rays + kRaysPerInvocation - 1u) / kRaysPerInvocation, min(rays, kTraceInvocations));
}

#endif
