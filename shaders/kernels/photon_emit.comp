#version 460
// Photons leave the lights: a light by its power, a point on it and a direction.
#extension GL_GOOGLE_include_directive : require
#include "bindings/lights.glsl"
#include "bindings/paths.glsl"
#include "lib/path.glsl"

layout(push_constant, scalar) uniform PushBlock { PhotonEmitPush push; };

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  const uint photon = push.firstPhoton + slot;
  const uint stream = hashCombine(params.seed, kStreamPhotons);
  const uint index = params.pass * params.photonsPerPass + photon;  // one sequence runs through all passes

  // Walker's alias table: the light by its power. What the choice leaves of the number places the point.
  vec2 place = sequencePoint(stream, index, kPairPosition);
  const float u = place.x * float(params.lightCount);
  const uint entry = min(uint(u), params.lightCount - 1u);
  const LightAlias alias = lightAliasAt(entry);
  const float rest = u - float(entry);
  const bool isOwn = rest < alias.threshold;
  const uint light = isOwn ? entry : alias.other;
  place.x = min(isOwn ? rest / alias.threshold : (rest - alias.threshold) / (1.0 - alias.threshold), 0.99999994);
  const float probability = lightAliasAt(light).probability;

  const Emission e = emitFromLight(light, place, sequencePoint(stream, index, kPairDirection), params.sceneCentre,
                                   params.sceneRadius);
  PathState path;
  path.throughput = e.flux / (probability * float(params.photonsPerPass));
  path.flags = 0u;
  path.id = photon;
  path.medium = kNone;
  path.outerMedium = kNone;
  path.pdfSolidAngle = 0.0;
  path.lightWeight = 0.0;
  path.distance = 0.0;
  const bool isAlive = maxComponent(path.throughput) > 0.0;
  rays[slot] = Ray(e.origin, isAlive ? kInfinity : 0.0, e.direction, hash(index));
  paths[slot] = path;
  queue[slot] = slot;
}
