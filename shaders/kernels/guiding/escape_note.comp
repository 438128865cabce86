#version 460
// Importance that leaves the scene, as photons that came the other way would bring it: what the environment's photons
// are aimed by.
#extension GL_GOOGLE_include_directive : require
#include "bindings/lights.glsl"
#include "bindings/paths.glsl"
#include "lib/environment_guide.glsl"

layout(scalar) writeonly buffer EscapesBlock { EscapeRecord escapes[]; };
layout(push_constant, scalar) uniform Push {
  uint source;
  uint first;      // path of slot 0
  uint isCaustic;  // only what was mirrored or refracted counts
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source]) return;
  const uint slot = queue[i];
  const Ray ray = rayAt(slot);
  if (ray.tMax <= 0.0 || hitAt(slot).triangle != kNone) return;
  const PathState path = paths[slot];
  if (push.isCaustic != 0u && (path.flags & kPathSpecular) == 0u) return;
  EscapeRecord e;
  e.origin = ray.origin;
  e.weight = mean(path.throughput * environmentRadiance(ray.direction));
  e.direction = ray.direction;
  e.pdf = pdfEnvironment(ray.direction);
  e.place = escapePlace(ray.direction);
  escapes[push.first + slot] = e;
}
