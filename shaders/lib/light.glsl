// Lights: choosing one for a point, sampling it, and emitting photons from it.
// The kernel defines `uvec4 lightTexel(uint index)` (four per light: position and kind; direction and power;
// emission and area; triangle, two-sidedness, cosines of a spot), `LightAlias lightAliasAt(uint index)`, `uvec2
// lightsSeen(vec3 x)` (a bit for each group of lights, lightGroup(), that is known to reach the surroundings of x) and
// includes lib/surface.glsl and what lib/environment.glsl and lib/light_tree.glsl ask for before this file.
#ifndef IMPORTON_LIB_LIGHT_GLSL
#define IMPORTON_LIB_LIGHT_GLSL
#include "lib/alpha.glsl"
#include "lib/hash.glsl"
#include "lib/environment.glsl"
#include "lib/light_tree.glsl"
#include "shared/elementary.h"

struct LightSample {
  vec3 direction;   // to the light, unit length
  float distance;   // m, infinite for directional lights and the environment
  vec3 target;      // where a shadow ray ends: off the light's surface; if the distance is finite
  vec3 radiance;    // divided by the density of sampling and of choosing the light: what f·cos multiplies
  float pdf;        // 1/sr, choosing included; 0: no other technique finds this light
};

Light lightAt(uint index) {
  const uvec4 t0 = lightTexel(4u * index), t1 = lightTexel(4u * index + 1u);
  const uvec4 t2 = lightTexel(4u * index + 2u), t3 = lightTexel(4u * index + 3u);
  Light light;
  light.position = uintBitsToFloat(t0.xyz);
  light.kind = t0.w;
  light.direction = uintBitsToFloat(t1.xyz);
  light.power = uintBitsToFloat(t1.w);
  light.emission = uintBitsToFloat(t2.xyz);
  light.area = uintBitsToFloat(t2.w);
  light.triangle = t3.x;
  light.isTwoSided = t3.y;
  light.cosInner = uintBitsToFloat(t3.z);
  light.cosOuter = uintBitsToFloat(t3.w);
  return light;
}

/// Share of its intensity that a spot light sends at this cosine to its axis. [KHR_lights_punctual]
float spotFalloff(float cosInner, float cosOuter, float cosine) {
  const float t = clamp((cosine - cosOuter) / max(cosInner - cosOuter, 1e-9), 0.0, 1.0);
  return t * t;
}

/// Share of its greatest intensity that a light with a profile sends along a direction.
float profileShare(Light light, vec3 direction) {
  const vec3 local = direction * frameAround(light.direction);
  const float around = dot(local.xy, local.xy) > 0.0 ? portableAtan(local.y, local.x) - light.area : 0.0;
  const float azimuth = light.isTwoSided != 0u ? around : -around;  // the lamp looks along its -z
  const vec2 place = vec2(azimuth / (2.0 * kPi), portableAcos(clamp(local.z, -1.0, 1.0)) / kPi);
  return sampleTexture(light.triangle, place, place).r;
}

/// Irradiance that a light may bring to x, roughly: the weight of choosing it. Zero only where it brings none.
float lightWeight(uint index, vec3 x) {
  const uvec4 t0 = lightTexel(4u * index), t1 = lightTexel(4u * index + 1u), t2 = lightTexel(4u * index + 2u);
  const uint kind = t0.w;
  if (kind == kLightDirectional) return mean(uintBitsToFloat(t2.xyz));
  if (kind == kLightEnvironment) return kPi * mean(uintBitsToFloat(t2.xyz));
  const vec3 to = uintBitsToFloat(t0.xyz) - x;
  const float d2 = dot(to, to), power = uintBitsToFloat(t1.w);
  if (kind == kLightSpot) {
    const uvec4 t3 = lightTexel(4u * index + 3u);
    const float cosine = -dot(to, uintBitsToFloat(t1.xyz)) * inversesqrt(max(d2, 1e-30));
    return mean(uintBitsToFloat(t2.xyz)) * spotFalloff(uintBitsToFloat(t3.z), uintBitsToFloat(t3.w), cosine) /
           max(d2, 1e-30);
  }
  if (kHasLightProfiles && kind == kLightProfile)
    return mean(uintBitsToFloat(t2.xyz)) * profileShare(lightAt(index), -to * inversesqrt(max(d2, 1e-30))) /
           max(d2, 1e-30);
  if (kind == kLightPoint) return power / (4.0 * kPi * max(d2, 1e-30));
  const bool isBehind = dot(to, uintBitsToFloat(t1.xyz)) > 0.0 && lightTexel(4u * index + 3u).y == 0u;
  if (isBehind) return 0.0;  // exact: all of the light lies in one plane
  return power / (kPi * max(d2, uintBitsToFloat(t2.w)));
}

bool isLightSeen(uvec2 seen, uint index) {
  return ((index < 32u ? seen.x >> index : seen.y >> (index - 32u)) & 1u) != 0u;
}

/// The weight of choosing one of at most kLinearLights lights.
float weightOfLight(uint index, vec3 x, uvec2 seen) {
  const float weight = lightWeight(index, x);
  return isLightSeen(seen, index) ? weight : unseenLight() * weight;
}

/// Chooses one of the weighed lights; sums their weights.
uint chooseByWeight(uint count, vec3 x, inout float u, out float weightSum) {
  // One pass: each light replaces the choice so far with its share of the sum so far; u is used up bit by bit.
  weightSum = 0.0;
  uint chosen = kNone;
  const uvec2 seen = lightsSeen(x);
  for (uint i = 0u; i < count; ++i) {
    const float w = weightOfLight(i, x, seen);
    if (w <= 0.0) continue;
    weightSum += w;
    const float share = w / weightSum;
    if (u < share || chosen == kNone) {
      u = chosen == kNone ? u : u / share;
      chosen = i;
    } else {
      u = (u - share) / (1.0 - share);
    }
  }
  return chosen;
}

// Share of choices that take every light alike: a strong light may be hidden where a weak one is all there is.
const float kDefensiveShare = 0.1;

/// Probability with which chooseLight takes `index` at x; of lights that bring nothing there, anything.
float lightProbability(uint count, uint index, vec3 x, float weightSum) {
  if (count == 1u) return 1.0;
  float byWeight = 0.0;
  if (count > kLinearLights) byWeight = treeProbability(count, index, x, lightsSeen(x));
  else if (weightSum > 0.0) byWeight = weightOfLight(index, x, lightsSeen(x)) / weightSum;
  return mix(byWeight, 1.0 / float(count), kDefensiveShare);
}

/// Chooses a light for x with u, and leaves in u what the choice did not use, uniform in [0, 1) again: a point on the
/// light by it keeps the sequence's evenness over all lights together. `weightSum` is what lightProbability needs to
/// know of the choice. kNone: none brings light.
uint chooseLight(uint count, vec3 x, inout float u, out float probability, out float weightSum) {
  probability = weightSum = 0.0;
  if (count == 0u) return kNone;
  if (count == 1u) {
    probability = 1.0;
    return 0u;
  }
  const bool isDefensive = u < kDefensiveShare;
  const float scaled = (isDefensive ? u / kDefensiveShare : (u - kDefensiveShare) / (1.0 - kDefensiveShare));
  u = scaled;
  uint chosen;
  float unused;
  if (count > kLinearLights) {
    chosen = isDefensive ? 0u : chooseFromTree(x, lightsSeen(x), scaled, unused);
    u = unitFloat(hash(floatBitsToUint(scaled)));  // the way down the tree uses up most bits
  } else {
    chosen = chooseByWeight(count, x, u, weightSum);
  }
  if (chosen == kNone) return kNone;
  if (isDefensive) {
    chosen = min(uint(scaled * float(count)), count - 1u);
    u = fract(scaled * float(count));
  }
  probability = lightProbability(count, chosen, x, weightSum);
  return chosen;
}

struct TrianglePoint {
  vec3 position;
  vec3 error;
  vec3 normal;     // front side
  float area;      // m²
  vec3 radiance;   // W/(m² sr), none where alpha has cut the surface away
};

TrianglePoint lightTrianglePoint(uint triangle, vec2 u) {
  const uvec4 indices = triangleTexel(triangle);
  const vec3 p0 = vertexPosition(indices.x), p1 = vertexPosition(indices.y), p2 = vertexPosition(indices.z);
  const vec2 w = sampleTriangle(u);
  TrianglePoint p;
  const HitPosition hit = hitPosition(p0, p1, p2, w.x, w.y);
  p.position = hit.position;
  p.error = hit.error;
  p.normal = triangleNormal(p0, p1, p2);
  p.area = 0.5 * length(cross(p1 - p0, p2 - p0));
  p.radiance = uintBitsToFloat(materialTexel(kMaterialTexels * indices.w + 1u)).rgb;
  if (kHasTextures) {
    const uint texture = materialTexel(kMaterialTexels * indices.w + 6u).z;
    if (texture != kNone) {
      vec2 uv0, uv1;
      interpolateUv(indices.xyz, vec3(1.0 - w.x - w.y, w), uv0, uv1);
      p.radiance *= sampleTexture(texture, uv0, uv1).rgb;
    }
  }
  if (kHasCutLights) p.radiance *= coverageAt(indices, vec3(1.0 - w.x - w.y, w));
  return p;
}

/// A sample of light `index`, chosen with `probability`, as seen from x.
LightSample sampleLight(uint index, float probability, vec3 x, vec2 u) {
  const Light light = lightAt(index);
  LightSample s;
  s.radiance = vec3(0.0);
  s.pdf = 0.0;
  s.direction = vec3(0.0, 0.0, 1.0);
  s.distance = kInfinity;
  s.target = vec3(0.0);
  if (kHasTriangleLights && light.kind == kLightTriangle) {
    const TrianglePoint p = lightTrianglePoint(light.triangle, u);
    const vec3 to = p.position - x;
    const float d2 = dot(to, to);
    s.distance = sqrt(d2);
    s.direction = to / s.distance;
    float cosine = -dot(p.normal, s.direction);
    if (light.isTwoSided != 0u) cosine = abs(cosine);
    if (cosine <= 0.0 || d2 <= 0.0) return s;
    s.pdf = probability * d2 / (cosine * p.area);
    s.target = offsetOrigin(p.position, p.error, p.normal, -s.direction);
    s.radiance = p.radiance / s.pdf;
  } else if (kHasEnvironment && light.kind == kLightEnvironment) {
    float pdf;
    s.direction = sampleEnvironment(u, pdf);
    s.pdf = probability * pdf;
    s.radiance = environmentRadiance(s.direction) / s.pdf;
  } else if (kHasPunctualLights) {
    if (light.kind == kLightDirectional) {
      s.direction = -light.direction;
      s.radiance = light.emission / probability;
    } else {
      const vec3 to = light.position - x;
      const float d2 = max(dot(to, to), 1e-30);
      s.target = light.position;
      s.distance = sqrt(d2);
      s.direction = to / s.distance;
      float falloff = 1.0;
      if (light.kind == kLightSpot)
        falloff = spotFalloff(light.cosInner, light.cosOuter, -dot(light.direction, s.direction));
      if (kHasLightProfiles && light.kind == kLightProfile) falloff = profileShare(light, -s.direction);
      s.radiance = light.emission * (falloff / (d2 * probability));
    }
  }
  return s;
}

/// Density (1/sr, choosing included) with which light sampling at x finds the point at `distance` on a light
/// triangle whose normal makes `cosine` with the ray.
float pdfTriangleLight(uint count, uint index, vec3 x, float weightSum, float distance, float cosine) {
  const Light light = lightAt(index);
  const float probability = lightProbability(count, index, x, weightSum);
  return probability * distance * distance / max(cosine * light.area, 1e-30);
}

struct Emission {
  vec3 origin;
  vec3 direction;
  vec3 flux;   // W, of the light as a whole, for this sample
};

/// A photon of a light: uPoint on its surface (or across its beam), uDirection.
Emission emitFromLight(uint index, vec2 uPoint, vec2 uDirection, vec3 sceneCentre, float sceneRadius) {
  const Light light = lightAt(index);
  Emission e;
  e.origin = light.position;
  e.direction = light.direction;
  e.flux = vec3(0.0);
  if (kHasTriangleLights && light.kind == kLightTriangle) {
    const bool isTwoSided = light.isTwoSided != 0u;
    const bool isBack = isTwoSided && uDirection.x >= 0.5;
    if (isTwoSided) uDirection.x = 2.0 * uDirection.x - (isBack ? 1.0 : 0.0);
    const TrianglePoint p = lightTrianglePoint(light.triangle, uPoint);
    const vec3 n = isBack ? -p.normal : p.normal;
    e.direction = frameAround(n) * sampleCosineHemisphere(uDirection);
    e.origin = offsetOrigin(p.position, p.error, n, e.direction);
    e.flux = p.radiance * (kPi * p.area * (isTwoSided ? 2.0 : 1.0));
  } else if (kHasEnvironment && light.kind == kLightEnvironment) {
    float pdf;
    e.direction = -sampleEnvironment(uDirection, pdf);
    e.origin = sceneCentre + frameAround(e.direction) * vec3(sampleDisc(uPoint) * sceneRadius, -sceneRadius);
    e.flux = environmentRadiance(-e.direction) * (kPi * sceneRadius * sceneRadius / pdf);
  } else if (kHasPunctualLights) {
    if (light.kind == kLightDirectional) {
      e.origin = sceneCentre + frameAround(e.direction) * vec3(sampleDisc(uPoint) * sceneRadius, -sceneRadius);
      e.flux = light.emission * (kPi * sceneRadius * sceneRadius);
    } else if (light.kind == kLightSpot) {
      const vec3 local = sampleCone(uDirection, light.cosOuter);
      e.direction = frameAround(light.direction) * local;
      e.flux =
          light.emission * (spotFalloff(light.cosInner, light.cosOuter, local.z) * 2.0 * kPi * (1.0 - light.cosOuter));
    } else if (kHasLightProfiles && light.kind == kLightProfile) {
      e.direction = frameAround(light.direction) * sampleCone(uDirection, light.cosOuter);
      e.flux = light.emission * (profileShare(light, e.direction) * 2.0 * kPi * (1.0 - light.cosOuter));
    } else {
      e.direction = sampleSphere(uDirection);
      e.flux = light.emission * (4.0 * kPi);
    }
  }
  return e;
}

#endif
