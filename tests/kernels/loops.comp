// Values that leave loops, where each lane leaves in a turn of its own: see loops_test.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer In { uint items[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { uvec4 results[]; };
layout(push_constant, scalar) uniform Push { uint count; uint turn; };

uint collatz(uint x) { return (x & 1u) == 0u ? x / 2u : 3u * x + 1u; }

/// Steps to 1, taken one by one; what is read in a step is used after the loop.
uvec4 single(uint x) {
  uint steps = 0u, last;
  bool isOver;
  do {
    last = items[x % count];
    isOver = x == 1u;
    x = collatz(x);
    ++steps;
  } while (!isOver);
  return uvec4(steps, last, x, uint(isOver));
}

const uint kNoNumber = 0xFFFFFFFFu;

/// The same, in turns of so many steps, for one number after the other, with a stack.
uint stack[64];
uvec4 queue(uint x) {
  uvec4 sum = uvec4(0u);
  uint steps = 0u, last = 0u, taken = 0u, depth = 0u;
  bool isOver = true;
  uint number = kNoNumber;
  do {
    if (isOver) {
      if (number != kNoNumber) sum += uvec4(steps, last, x, stack[depth & 63u]);
      number = kNoNumber;
      if (taken < 5u) {
        number = items[(gl_GlobalInvocationID.x + 7u * taken) % count];
        ++taken;
        x = number;
        steps = 0u;
        depth = 0u;
        isOver = false;
      }
    }
    if (number != kNoNumber) {
      uint left = turn;
      do {
        last = items[x % count];
        stack[depth & 63u] = last;
        isOver = x == 1u;
        depth += isOver ? 0u : 1u;
        x = collatz(x);
        ++steps;
        --left;
      } while (!isOver && left > 0u);
    }
  } while (number != kNoNumber);
  return sum;
}

void main() {
  const uint index = invocationIndex();
  if (index >= count) return;
  const uint x = items[index];
  results[2u * index] = single(x);
  results[2u * index + 1u] = queue(x);
}
