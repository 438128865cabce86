#version 460
// Functions that src/gpu/rounded_division.cpp puts into kernels.
#extension GL_GOOGLE_include_directive : require
#include "lib/rounding.glsl"

void main() {  // calls them, so that the compiler keeps them
  roundedQuotient(1.0, 1.0);
  roundedRoot(1.0);
}
