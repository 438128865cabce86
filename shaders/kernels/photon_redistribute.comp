#version 460
// A rejected hit hands its power to the M' nearest stored photons of its surface. A receiver takes power from
// within its own quota radius only, so none crosses a step of importance; without a receiver the hit is stored
// after all. [Suykens and Willems 2000, with the limits of METHOD: a door slit needs them]
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/photons.glsl"
#include "bindings/selection.glsl"
#include "bindings/stored.glsl"

const uint kMaxReceivers = 32u;
layout(push_constant, scalar) uniform PushBlock { PhotonRedistributePush push; };

uint photons[kMaxReceivers];
float distances[kMaxReceivers];

/// Keeps the nearest receivers, sorted by distance; returns their new number.
uint insertReceiver(uint count, uint photon, float d2) {
  uint at = min(count, push.receivers - 1u);
  if (count == push.receivers && d2 >= distances[at]) return count;
  for (; at > 0u && distances[at - 1u] > d2; --at) {
    distances[at] = distances[at - 1u];
    photons[at] = photons[at - 1u];
  }
  distances[at] = d2;
  photons[at] = photon;
  return min(count + 1u, push.receivers);
}

/// Keeps the receivers among the points of the walk that lie within `radius`.
uint takeReceivers(Walk walk, GridFrame frame, vec3 normal, float radius) {
  uint count = 0u;
  while (nextPoint(walk)) {
    // Three eighths of its cell's edge are at most the receiver's quota radius.
    const float own = min(radius, 0.375 * gridCellEdge(frame, walk.level));
    if (isInside(walk, normal, own) && hasLikeNormal(walk.packed, normal, kLikeNormal))
      count = insertReceiver(count, texelFetch(storedOrder, int(walk.index)).x, dot(walk.offset, walk.offset));
  }
  return count;
}

uint findReceivers(MapPoint point, float radius) {
  const vec3 normal = mapPointNormal(point.packed);
  const GridFrame frame = storedFrame();
  // Those of the own cell tell how far the nearest ones can be.
  const uint near = takeReceivers(beginWalkCell(frame, point.position, mapPointLevel(point.packed)), frame, normal, radius);
  const float reach = near == push.receivers ? min(radius, sqrt(distances[near - 1u]) * 1.0001) : radius;
  return takeReceivers(beginWalk(frame, counters[kCounterStoredLevels], point.position, normal, reach, radius), frame,
                       normal, reach);
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  if (keep[i] != 0u) {
    keep[i] = 0u;  // stored already
    return;
  }
  const uint count = findReceivers(selectedPoints[i], quotaRadius(required[i]));
  keep[i] = uint(count == 0u);
  if (count == 0u) return;
  const vec3 flux = records[selection[i]].flux * params.fluxScale;
  for (uint c = 0u; c < 3u; ++c) {
    uint rest;
    const uvec2 share = divideFixed(fixedFromFloat(flux[c]), count, rest);
    addToPhoton(photons[0], c, addFixed(share, uvec2(rest, 0u)));
    for (uint k = 1u; k < count; ++k) addToPhoton(photons[k], c, share);
  }
}
