// glTF textures out of plain buffers: wrapping, interpolation and sRGB as a sampler would do them, the same on
// every device. The kernel defines `uvec4 textureTexel(uint index)` (four per texture) and
// `uint imageTexel(uint index)` (a word: RGBA8, or half of RGBA16) before including this file.
#ifndef IMPORTON_LIB_TEXTURE_GLSL
#define IMPORTON_LIB_TEXTURE_GLSL
#include "lib/features.glsl"
#include "shared/elementary.h"

int wrapTexel(int i, int size, uint mode) {
  const int period = mode == kWrapRepeat ? size : 2 * size;
  int m = i % period;
  m = m < 0 ? m + period : m;
  m = m < size ? m : period - 1 - m;
  return mode == kWrapClamp ? clamp(i, 0, size - 1) : m;
}

/// IEC 61966-2-1.
vec3 linearFromSrgb(vec3 c) {
  const vec3 low = c * (1.0 / 12.92);
  const vec3 high = portablePow((c + 0.055) * (1.0 / 1.055), 2.4);
  return mix(high, low, lessThanEqual(c, vec3(0.04045)));
}

/// The texel whose first word is `word`.
vec4 decodeTexel(uint word, bool isSrgb, bool isDeep) {
  const uint head = imageTexel(word);
  const vec4 c = isDeep ? vec4(unpackUnorm2x16(head), unpackUnorm2x16(imageTexel(word + 1u))) : unpackUnorm4x8(head);
  return isSrgb ? vec4(linearFromSrgb(c.rgb), c.a) : c;
}

/// Sample of texture `index` at the vertex's UV sets, linear RGBA.
vec4 sampleTexture(uint index, vec2 uv0, vec2 uv1) {
  const uvec4 head = textureTexel(4u * index);           // firstTexel, width, height, wrapS
  const uvec4 mode = textureTexel(4u * index + 1u);      // wrapT, isNearest, isSrgb, uvSet
  const vec4 rowA = uintBitsToFloat(textureTexel(4u * index + 2u));  // uvRow0, uvRow1.x
  const vec4 rowB = uintBitsToFloat(textureTexel(4u * index + 3u));  // uvRow1.yz, isDeep
  const vec3 uv = vec3(mode.w == 0u ? uv0 : uv1, 1.0);
  const vec2 size = vec2(head.yz);
  // Whole turns of a repeating texture cancel; what remains is small enough for int.
  const vec2 p = clamp(vec2(dot(rowA.xyz, uv), dot(vec3(rowA.w, rowB.xy), uv)), vec2(-1e5), vec2(1e5)) * size;
  const bool isSrgb = mode.z != 0u;
  // The nearest texel is the first of four that the others add nothing to.
  const bool isNearest = mode.y != 0u;
  const vec2 q = isNearest ? p : p - 0.5;
  const ivec2 i = ivec2(floor(q));
  const vec2 f = isNearest ? vec2(0.0) : q - floor(q);
  const bool isDeep = kHasDeepTextures && floatBitsToUint(rowB.z) != 0u;
  const uint words = isDeep ? 2u : 1u;  // a texel
  const uint x0 = uint(wrapTexel(i.x, int(head.y), head.w)) * words;
  const uint x1 = uint(wrapTexel(i.x + 1, int(head.y), head.w)) * words;
  const uint y0 = head.x + uint(wrapTexel(i.y, int(head.z), mode.x)) * head.y * words;
  const uint y1 = head.x + uint(wrapTexel(i.y + 1, int(head.z), mode.x)) * head.y * words;
  const vec4 top = mix(decodeTexel(y0 + x0, isSrgb, isDeep), decodeTexel(y0 + x1, isSrgb, isDeep), f.x);
  const vec4 bottom = mix(decodeTexel(y1 + x0, isSrgb, isDeep), decodeTexel(y1 + x1, isSrgb, isDeep), f.x);
  return mix(top, bottom, f.y);
}

#endif
