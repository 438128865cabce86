// KHR_materials_dispersion: each channel of colour has its own index of refraction, so a path that meets such a solid
// goes on with one of the three.
#ifndef IMPORTON_LIB_DISPERSION_GLSL
#define IMPORTON_LIB_DISPERSION_GLSL
#include "lib/sampling.glsl"

/// The index of a channel (0: red). `dispersion`: 20 over the Abbe number.
float dispersedIndex(float ior, float dispersion, uint channel) {
  return max(ior + (float(channel) - 1.0) * (ior - 1.0) * 0.025 * dispersion, 1.0);
}

/// The channel of a path that has one alone.
uint channelOf(vec3 throughput) {
  return throughput.r >= max(throughput.g, throughput.b) ? 0u : throughput.g >= throughput.b ? 1u : 2u;
}

/// Keeps one channel, chosen by its part of the throughput; the mean stays. `u`: uniform in [0, 1).
vec3 keepChannel(vec3 throughput, float u) {
  const float sum = throughput.r + throughput.g + throughput.b;
  if (sum <= 0.0) return throughput;
  const vec3 share = throughput / sum;
  const uint channel = u < share.r ? 0u : (u < share.r + share.g || share.b <= 0.0) ? 1u : 2u;
  vec3 kept = vec3(0.0);
  kept[channel] = throughput[channel] / max(share[channel], 1e-30);
  return kept;
}

#endif
