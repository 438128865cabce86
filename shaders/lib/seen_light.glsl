// How much of the light of a photon on a glossy surface goes where an importon looked from: directional importance.
#ifndef IMPORTON_LIB_SEEN_LIGHT_GLSL
#define IMPORTON_LIB_SEEN_LIGHT_GLSL

/// For a photon from `light`, an importon from `view` and the normal, all unit: the GGX distribution at the half vector
/// over its peak, for the roughest surface that counts as glossy (isGlossy), and a tenth for what the surface scatters
/// otherwise.
float seenShare(vec3 view, vec3 light, vec3 normal) {
  const float kAlpha = 0.3, kOtherwise = 0.1;
  const vec3 h = normalize(view + light + 1e-6 * normal);
  const float cosine = max(dot(h, normal), 0.0);
  const float lobe = kAlpha * kAlpha / (1.0 - cosine * cosine * (1.0 - kAlpha * kAlpha));
  return kOtherwise + (1.0 - kOtherwise) * lobe * lobe;
}

#endif
