#version 460
// A photon meets a surface: it leaves a record there and goes on by the adjoint BSDF, or is absorbed. Photons for the
// caustic map leave one only after specular events, and end with the first other one.
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "bindings/paths.glsl"
#include "bindings/records.glsl"
#include "bindings/irradiance.glsl"
#include "bindings/lights_seen.glsl"
#include "bindings/scatter_guide.glsl"
#include "lib/map_point.glsl"
#include "lib/path.glsl"
#include "lib/photon_stream.glsl"

layout(constant_id = kSpecScatterIsGuided) const bool kScatterIsGuided = false;
layout(constant_id = kSpecPhotonKind) const uint kPhotonKind = kPhotonsGlobal;
layout(scalar) writeonly buffer RecordCellsBlock { uvec2 recordCells[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint stream;
  ScatterGrid guide;
} push;

MapSettings mapOfPhotons() {
  if (kPhotonKind == kPhotonsGlobal) return params.globalMap;
  return params.causticMap;
}

void writeRecord(uint at, Surface s, bool isGlossy, vec3 direction, PathState path) {
  if (kPhotonKind == kPhotonsCaustic && (path.flags & kPathSpecular) == 0u) return;
  const uint kind = kPhotonKind == kPhotonsCaustic ? kRecordCaustic : kRecordGlobal;
  const uint rank = path.id << 5 | min(path.flags & kPathDepthMask, 31u);
  recordPoints[at] = MapPoint(s.position, packMapPoint(-direction, s.mapNormal, 0u));
  records[at] = Record(path.throughput, kind | (isGlossy ? kRecordGlossy : 0u) | rank << kRecordRankShift);
}

/// Notes the cell that the photon fell in, and what of its flux is diffusely reflected light's: flux comes per area of
/// the true surface, the BSDF's cosine is the shading normal's. The bound keeps a grazing photon from outshining all.
void writeCell(uint at, Surface s, Hit hit, Bsdf b, vec3 direction, float cosIn) {
  const float cosine = max(abs(dot(direction, s.geometricNormal)), min(cosIn, 0.05));
  const float weight = cosIn > 0.0 ? diffuseFrom(b, cosIn) * cosIn / cosine : 0.0;
  recordCells[at] = uvec2(cellSide(hit.triangle, vec2(hit.u, hit.v), s.isFront), floatBitsToUint(weight));
}

/// Scatters the photon; false: absorbed. Throughput keeps its mean by Russian roulette.
bool scatter(Surface s, Bsdf b, vec3 direction, inout PathState path, out Ray ray) {
  const MapSettings map = mapOfPhotons();
  const uint stream = photonStream(push.stream, map, path.id), index = photonIndex(map, path.id);
  const vec2 choice = sequencePoint(stream, index, eventPair(path.flags, kPairLobe));
  const vec3 towardsLight = -direction * s.frame;
  const vec2 u = sequencePoint(stream, index, eventPair(path.flags, kPairScatter));
  float scale = 1.0;
  BsdfSample next;
  if (kScatterIsGuided)
    next = sampleGuidedBsdf(b, towardsLight, scatterGuideAt(push.guide, b, s.position, s.frame[2]), choice.x, u, scale);
  else next = sampleBsdf(b, towardsLight, choice.x, u);
  const vec3 wi = s.frame * next.wi;
  ray = nextRay(s, wi, hash(index ^ hash(path.flags)));
  if (!isConsistent(s, wi, next.isTransmission)) return false;
  const vec3 weight = next.weight * adjointFactor(s, direction, towardsLight.z, wi, next.wi.z);
  const float survival = min(1.0, maxComponent(weight * path.throughput) / max(maxComponent(path.throughput), 1e-38));
  if (!(choice.y < survival)) return false;
  const bool isSpecular = next.isDelta || isFrosted(b);
  if (kPhotonKind == kPhotonsCaustic && !isSpecular) return false;
  path.throughput *= weight / survival;
  if (kScatterIsGuided) path.throughput *= scale;
  if (updateMedia(path, s, next.isTransmission)) atomicAdd(counters[kCounterMediaForgotten], 1u);
  path.flags += 1u;
  if (!passesPane(s, next)) {
    path.flags |= isSpecular ? kPathSpecular : kPathScattered;
    if (!isSpecular) path.flags &= ~kPathSpecular;
  }
  return (path.flags & kPathDepthMask) <= params.maxDepth;
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source]) return;
  const uint slot = queue[i], at = counters[kCounterRecords] + i;
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  keep[i] = 0u;
  records[at].kind = kRecordNone;
  if (ray.tMax <= 0.0 || hit.triangle == kNone) return;
  PathState path = paths[slot];
  Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  chooseChannel(s, path, ray.id, params.pass);
  relateIndex(s, path);
  if ((s.flags & kMaterialUnlit) != 0u) return;
  if (kHasMedia) path.throughput *= mediumTransmittance(path.media, s, hit.t);
  if (kScatterIsGuided) s.frame = scatterFrame(s.shadingNormal);
  const float cosIn = dot(-ray.direction, s.shadingNormal);
  Bsdf b = makeBsdf(s, cosIn);
  makeAdjoint(b);
  if (hasRoughLobe(b) && !isFrosted(b)) writeRecord(at, s, isGlossy(b), ray.direction, path);
  // Importance that is traced as photons are has no light.
  const bool isFromLight = (path.flags & (kPathScattered | kPathSpecular)) == 0u && path.source != kNone;
  if (kPhotonKind == kPhotonsGlobal && isFromLight) seeLight(path.source, s.position);
  if (kReadsCells && kPhotonKind == kPhotonsGlobal) writeCell(at, s, hit, b, ray.direction, cosIn);
  Ray next;
  if (!scatter(s, b, ray.direction, path, next)) return;
  keep[i] = 1u;
  rays[slot] = next;
  paths[slot] = path;
}
