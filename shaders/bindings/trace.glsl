// The main function of the traversal kernels. A kernel defines `uvec4 instanceTexel(uint)`, `bool acceptHit(uint
// stored, uint number, vec2 barycentrics, uint rayId)`, `void startRay(vec3 direction)`, `void endRay(uint slot, bool
// isFree)` and kMaxTurns, and includes this file.
//
// An invocation traces one ray after the other, so that the lanes of a SIMD group stay busy although rays differ in
// length: every few steps, those that are done take the next rays of the queue. Any number of invocations does; those
// that aren't needed leave at once.
#ifndef IMPORTON_BINDINGS_TRACE_GLSL
#define IMPORTON_BINDINGS_TRACE_GLSL
#include "bindings/parameters.glsl"
#include "shared/features.h"

layout(constant_id = kSpecAnyHit) const bool kIsAnyHit = false;

uniform usamplerBuffer bvhTexels;
uniform usamplerBuffer raysTexels;
layout(scalar) writeonly buffer HitsBlock { Hit hits[]; };
layout(scalar) readonly buffer QueueBlock { uint queue[]; };
layout(push_constant, scalar) uniform Push {
  uint source;  // counter of the queue
} push;

uvec4 bvhNodeTexel(uint index) { return texelFetch(bvhTexels, int(index)); }

#include "lib/trace_queue.glsl"
#include "lib/traverse.glsl"

const uint kStepsPerTurn = 2u;
// Lavapipe ends all loops of an invocation after 65535 iterations in total, a turn being kStepsPerTurn + 1 of them, so
// kMaxTurns is at most 21000, and less where the kernel's functions have loops. New rays are taken up to half of that;
// a ray that is not done by the end is counted in kCounterTraceUnfinished.

void main() {
  const uint count = counters[push.source];
  const uint invocations = min(traceInvocations(count),
                               gl_NumWorkGroups.x * gl_NumWorkGroups.y * gl_WorkGroupSize.x);
  if (invocationIndex() >= invocations) return;
  Traversal traversal;
  traversal.hit = Hit(0.0, 0.0, 0.0, kNone);
  traversal.hitKind = kBvhLeaf;
  if (kHasInstances) setRay(traversal, vec3(0.0), vec3(0.0, 0.0, 1.0), 0.0, 0u);
  uint slot = kNone;
  uint turn = 0u;
  bool isOver = true;
  do {
    if (isOver) {
      if (slot != kNone) {
        hits[slot] = traversalHit(traversal);
        endRay(slot, traversal.hit.triangle == kNone);
      }
      slot = kNone;
      const uint next = turn < kMaxTurns / 2u ? atomicAdd(counters[kCounterTraceTaken], 1u) : count;
      if (next < count) {
        slot = queue[next];
        const uvec4 a = texelFetch(raysTexels, int(2u * slot)), b = texelFetch(raysTexels, int(2u * slot + 1u));
        setRay(traversal, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(a.w), b.w);
        startRay(uintBitsToFloat(b.xyz));
        isOver = false;
      }
    }
    if (slot != kNone) {
      // A lane that comes to a mesh waits for the next turn, so that all change together. It must not leave the loop
      // for that: what lavapipe computes in the loop for other lanes would become its state.
      if (isAtMesh(traversal)) changeMesh(traversal);
      uint left = kStepsPerTurn;
      do {
        if (!isAtMesh(traversal)) isOver = stepTraversal(traversal, kIsAnyHit);
        --left;
      } while (!isOver && left > 0u);
    }
    ++turn;
  } while (slot != kNone && turn < kMaxTurns);

  if (slot != kNone) {
    hits[slot] = traversalHit(traversal);
    endRay(slot, traversal.hit.triangle == kNone);
    if (!isOver) atomicAdd(counters[kCounterTraceUnfinished], 1u);
  }
  // The last one leaves the counters ready for the next dispatch.
  if (atomicAdd(counters[kCounterTraceLeft], 1u) + 1u == invocations) {
    const uint taken = atomicExchange(counters[kCounterTraceTaken], 0u);
    atomicExchange(counters[kCounterTraceLeft], 0u);
    if (taken < count) atomicAdd(counters[kCounterTraceUnfinished], count - taken);
  }
}

#endif
