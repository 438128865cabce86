// Photons that share the power of a rejected hit, and how it is shared out: exactly, in fixed point.
#ifndef IMPORTON_BINDINGS_RECEIVERS_GLSL
#define IMPORTON_BINDINGS_RECEIVERS_GLSL
#include "bindings/photons.glsl"
#include "lib/features.glsl"

const uint kMaxReceivers = 32u;
uint photons[kMaxReceivers];
float distances[kMaxReceivers];  // squared, m²; later weights of the shares

const float kGlossyCone = 0.9;  // cosine within which light counts as coming from one direction

/// What a receiver must be like.
struct Giver {
  vec3 normal;
  vec3 direction;  // where its light came from
  bool isGlossy;
};

/// True if light along `direction` comes nearly as the giver's: from the same side of the surface.
bool comesAlike(vec3 direction, Giver giver) {
  const bool isSameSide = (dot(direction, giver.normal) < 0.0) == (dot(giver.direction, giver.normal) < 0.0);
  return dot(direction, giver.direction) > kGlossyCone && (!kHasDiffuseTransmission || isSameSide);
}

/// Turns distances into weights of the shares; returns their sum.
float weighReceivers(uint count, float radius, Giver giver, bool byDirection) {
  float sum = 0.0;
  for (uint k = 0u; k < count; ++k) {
    float weight = 1.0 - distances[k] / (radius * radius);
    if (byDirection) {
      const float cosine = max(dot(mapPointDirection(photonPoints[photons[k]].packed), giver.direction), 0.0);
      weight = cosine * cosine;
    }
    distances[k] = max(weight, 1e-3);
    sum += distances[k];
  }
  return sum;
}

void giveEqually(vec3 flux, uint count) {
  for (uint c = 0u; c < 3u; ++c) {
    uint rest;
    const uvec2 share = divideFixed(fixedFromFloat(flux[c]), count, rest);
    addToPhoton(photons[0], c, addFixed(share, uvec2(rest, 0u)));
    for (uint k = 1u; k < count; ++k) addToPhoton(photons[k], c, share);
  }
}

/// By weight; what rounding leaves goes to the receiver of the greatest.
void giveByWeight(vec3 flux, uint count, float sum) {
  uint greatest = 0u;
  for (uint k = 1u; k < count; ++k)
    if (distances[k] > distances[greatest]) greatest = k;
  for (uint c = 0u; c < 3u; ++c) {
    uvec2 rest = fixedFromFloat(flux[c]);
    for (uint k = 0u; k < count; ++k) {
      if (k == greatest) continue;
      const uvec2 share = fixedFromFloat(floor(flux[c] * (distances[k] / sum)));
      addToPhoton(photons[k], c, share);
      rest = subtractFixed(rest, share);
    }
    addToPhoton(photons[greatest], c, rest);
  }
}

#endif
