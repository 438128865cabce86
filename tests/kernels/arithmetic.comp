// One operation or function of floats on many inputs: see arithmetic_test.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "shared/elementary.h"

layout(constant_id = 1) const uint kOperation = 0u;
layout(set = 0, binding = 0, scalar) readonly buffer In { vec3 items[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { float results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

float result(vec3 v) {
  const float a = v.x, b = v.y, c = v.z;
  switch (kOperation) {
    case 0u: return a + b;
    case 1u: return a - b;
    case 2u: return a * b;
    case 3u: return a / b;
    case 4u: return sqrt(a);
    case 5u: return a * b + c;
    case 6u: return a * b - c * a;
    case 7u: return (a + b) + (c - a);
    case 8u: return floor(a);
    case 9u: return ceil(a);
    case 10u: return min(a, b);
    case 11u: return max(a, b);
    case 12u: return clamp(a, -1.0, 1.0);
    case 13u: return portableFloat(floatBitsToUint(a));
    case 14u: return float(floatBitsToInt(a));
    case 15u: return intBitsToFloat(int(clamp(a, -1e9, 1e9)));
    case 16u: return uintBitsToFloat(uint(clamp(a, 0.0, 4e9)));
    case 17u: return unpackHalf2x16(floatBitsToUint(a)).x;
    case 18u: return unpackUnorm2x16(floatBitsToUint(a)).y;
    case 19u: return unpackSnorm2x16(floatBitsToUint(a)).y;
    case 20u: return unpackUnorm4x8(floatBitsToUint(a)).z;
    case 21u: return mix(a, b, c);
    case 22u: return dot(v, v.zxy);
    case 23u: return length(v);
    case 24u: return normalize(v).z;
    case 25u: return cross(v, v.yyx).y;
    case 26u: return inversesqrt(a);
    case 27u: return fract(a);
    case 28u: return sign(a);
    case 29u: return round(a);
    case 30u: return reflect(v, v.zxy).x;
    case 31u: return distance(v, v.yzx);
    case 32u: return 1.0 / a;
    case 33u: return a / 3.0;
    case 34u: return a * (1.0 - b) - (1.0 - b) * c;
    case 100u: return portableCos(a);
    case 101u: return portableSin(a);
    case 102u: return portableExp(a);
    case 103u: return portableExp2(a);
    case 104u: return portableLog(a);
    case 105u: return portableLog2(a);
    case 106u: return portablePow(abs(a), abs(b));
    case 107u: return portableAtan(a, b);
    case 108u: return portableAcos(clamp(a, -1.0, 1.0));
    default: return 0.0;
  }
}

void main() {
  const uint index = invocationIndex();
  if (index < count) results[index] = result(items[index]);
}
