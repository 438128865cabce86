#version 460
// Photons leave the lights: a light, a point on it and a direction, by power or by what a guide has learned.
#extension GL_GOOGLE_include_directive : require
#include "bindings/environment_guide.glsl"
#include "bindings/guide.glsl"
#include "bindings/lights.glsl"
#include "bindings/paths.glsl"
#include "lib/path.glsl"
#include "lib/photon_stream.glsl"

layout(constant_id = kSpecIsGuided) const bool kIsGuided = true;
layout(push_constant, scalar) uniform Push {
  uint firstPhoton;
  uint count;
  uint stream;
  uint bins;  // of the guide, along each axis; 0: by power
  uint isGlobal;
} push;

/// Walker's alias table: a light by its power. What the choice leaves of u.x is uniform again.
uint lightByPower(inout vec2 u, out float probability) {
  const float scaled = u.x * float(params.lightCount);
  const uint entry = min(uint(scaled), params.lightCount - 1u);
  const LightAlias alias = lightAliasAt(entry);
  const float rest = scaled - float(entry);
  const bool isOwn = rest < alias.threshold;
  const uint light = isOwn ? entry : alias.other;
  u.x = min(isOwn ? rest / alias.threshold : (rest - alias.threshold) / (1.0 - alias.threshold), 0.99999994);
  probability = lightAliasAt(light).probability;
  return light;
}

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const uint photon = push.firstPhoton + slot;
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const uint stream = photonStream(push.stream, map, photon), index = photonIndex(map, photon);
  vec2 place = sequencePoint(stream, index, kPairPosition), direction = sequencePoint(stream, index, kPairDirection);
  uint light;
  float density;
  if (kIsGuided) {
    const GuidedPoint p = sampleGuide(direction, params.lightCount, push.bins);
    light = p.light;
    density = p.density;
    direction = p.u;
    if (lightTexel(4u * light).w == kLightDirectional) {  // its places are guided
      direction = place;
      place = p.u;
    }
  } else {
    light = lightByPower(place, density);
  }
  Emission e;
  if (kIsGuided && kHasEnvironment && light == params.environmentLight && escapeLeaves() > 0u)
    e = emitFromEnvironment(place, direction, params.sceneCentre, params.sceneRadius);
  else e = emitFromLight(light, place, direction, params.sceneCentre, params.sceneRadius);
  PathState path;
  path.throughput = e.flux / (density * float(map.photonsPerPass));
  path.flags = 0u;
  path.id = photon;
  path.media = uvec2(0u);
  path.pdfSolidAngle = 0.0;
  path.lightWeight = 0.0;
  path.source = light;
  path.distance = 0.0;
  const bool isAlive = maxComponent(path.throughput) > 0.0;
  rays[slot] = Ray(e.origin, isAlive ? kInfinity : 0.0, e.direction, hash(index));
  paths[slot] = path;
  queue[slot] = slot;
}
