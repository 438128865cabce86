#version 460
// The footprint of each importon where it meets a surface, and what becomes of it there. Runs ahead of
// eye_scatter.comp, which draws the same directions, and writes beside its records.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "lib/camera.glsl"
#include "lib/eye_stream.glsl"
#include "lib/path.glsl"
#include "lib/differential.glsl"
#include "lib/sampled_spread.glsl"
#include "shared/elementary.h"

layout(scalar) buffer PathDifferentialsBlock { PathDifferential differentials[]; };
layout(scalar) writeonly buffer FootprintsBlock { float footprints[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
} push;

const float kLeastStep = 9.5367431640625e-7;  // 2^-20 of the scene: no footprint is smaller than the maps' finest cell

/// Logarithm of what a smooth surface sends on where light meets it at this cosine.
float logSpecular(Bsdf b, DrawnLobe lobe, float cosine) {
  if (lobe.isCoat) return portableLog(fresnelSchlick(vec3(kCoatF0), 1.0, cosine).x);
  const float share = lobe.isTransmission ? 1.0 - mean(clearFresnel(b, cosine)) : mean(bsdfFresnel(b, cosine));
  return portableLog(max(share, 1e-6));
}

void bend(inout PathDifferential d, Surface s, NormalField field, Bsdf b, vec3 wo, vec3 direction, float uLobe,
          BsdfSample sampled) {
  const DrawnLobe lobe = drawnLobe(b, uLobe, sampled);
  const float low = max(wo.z - 1e-3, 1e-4), high = min(wo.z + 1e-3, 1.0);
  SpecularEvent e;
  e.direction = direction;
  e.normal = s.shadingNormal;
  e.isTransmission = sampled.isTransmission;
  e.eta = b.isThin ? 1.0 : b.eta;
  e.weightSlope = (logSpecular(b, lobe, high) - logSpecular(b, lobe, low)) / (high - low);
  bendDifferential(d, e, field);
  d.share *= mean(deltaWeight(b, wo, sampled.wi, lobe.isCoat, 1.0));
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source]) return;
  const uint slot = queue[i];
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  if (hit.triangle == kNone) return;
  PathState path = paths[slot];
  PathDifferential d;
  if ((path.flags & kPathDepthMask) == 0u) d = cameraDifferential(params, ray.direction);
  else d = differentials[slot];

  Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  chooseChannel(s, path, ray.id, params.pass);
  relateIndex(s, path);
  if (kHasMedia) d.share *= mean(mediumTransmittance(path.media, s, hit.t));
  transferDifferential(d, hit.t, ray.direction, s.geometricNormal);
  const float least = kLeastStep * params.gridExtent;
  const float asked = d.share / max(footprintArea(d), least * least);
  footprints[counters[kCounterRecords] + i] = asked < kInfinity ? asked : 0.0;

  const vec3 wo = -ray.direction * frameAround(s.shadingNormal);
  const Bsdf b = makeBsdf(s, wo.z);
  const float uLobe = eyePoint(path, kPairLobe).x;
  const vec2 u = eyePoint(path, kPairScatter);
  const BsdfSample sampled = sampleBsdf(b, wo, uLobe, u);
  const NormalField field = loadNormalField(hit.triangle, vec2(hit.u, hit.v), s.isFront);
  if (sampled.isDelta) {
    bend(d, s, field, b, wo, ray.direction, uLobe, sampled);
  } else if (sampled.pdf > 0.0) {
    const mat3 frame = frameAround(s.shadingNormal);
    Spread stepU, stepV;
    sampledSpreads(b, wo, uLobe, u, sampled, float(params.samplesPerPass), stepU, stepV);
    stepU.direction = frame * stepU.direction;
    stepV.direction = frame * stepV.direction;
    scatterDifferential(d, s.shadingNormal, field, frame * sampled.wi, stepU, stepV);
    d.share *= mean(sampled.weight);
  }
  if (kHasTransmission && sampled.isTransmission && !b.isThin) d.share /= b.eta * b.eta;
  differentials[slot] = d;
}
