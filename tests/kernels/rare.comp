// Writes whether it has two rare features, and one that any scene may have.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "shared/features.h"

layout(constant_id = kSpecHasSheen) const bool kHasOne = true;
layout(constant_id = kSpecHasDispersion) const bool kHasOther = true;
layout(constant_id = kSpecHasMedia) const bool kHasCommon = true;

layout(scalar) writeonly buffer Out { uint results[3]; };

void main() {
  if (invocationIndex() != 0u) return;
  results[0] = results[1] = results[2] = 0u;
  if (kHasOne) results[0] = 1u;
  if (kHasOther) results[1] = 1u;
  if (kHasCommon) results[2] = 1u;
}
