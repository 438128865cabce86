#version 460
// A rejected hit hands its power to the M' nearest stored photons of its surface. A receiver takes power from
// within its own quota radius only, so none crosses a step of importance; without a receiver the hit is stored
// after all. On a glossy surface a receiver's light also comes from nearly the same direction. Shares are equal, or go
// with distance or direction. [Suykens and Willems 2000, with limits that a door slit needs]
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/photons.glsl"
#include "bindings/selection.glsl"
#include "bindings/stored.glsl"

layout(push_constant, scalar) uniform Push {
  uint receivers;
  uint shares;  // kShare*
} push;

#include "bindings/receivers.glsl"

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
uint takeReceivers(Walk walk, GridFrame frame, Giver giver, float radius) {
  uint count = 0u;
  while (nextPoint(walk)) {
    // Three eighths of its cell's edge are at most the receiver's quota radius.
    const float own = min(radius, 0.375 * gridCellEdge(frame, walk.level));
    if (!isInside(walk, giver.normal, own) || !hasLikeNormal(walk.packed, giver.normal, kLikeNormal)) continue;
    if (!giver.isGlossy || comesAlike(mapPointDirection(walk.packed), giver))
      count = insertReceiver(count, texelFetch(storedOrderWords, int(walk.index)).x, dot(walk.offset, walk.offset));
  }
  return count;
}

uint findReceivers(MapPoint point, Giver giver, float radius) {
  const GridFrame frame = storedFrame();
  // Those of the own cell tell how far the nearest ones can be.
  const uint near =
      takeReceivers(beginWalkCell(frame, point.position, mapPointLevel(point.packed)), frame, giver, radius);
  const float reach = near == push.receivers ? min(radius, sqrt(distances[near - 1u]) * 1.0001) : radius;
  return takeReceivers(beginWalk(frame, counters[kCounterStoredLevels], point.position, giver.normal, reach, radius),
                       frame, giver, reach);
}

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  if (keep[i] != 0u) {
    keep[i] = 0u;  // stored already
    return;
  }
  const MapPoint point = selectedPoints[i];
  const Giver giver = Giver(mapPointNormal(point.packed), mapPointDirection(point.packed),
                            (records[selection[i]].kind & kRecordGlossy) != 0u);
  const float radius = quotaRadius(required[i]);
  const uint count = findReceivers(point, giver, radius);
  keep[i] = uint(count == 0u);
  if (count == 0u) return;
  const vec3 flux = records[selection[i]].flux * params.fluxScale;
  if (push.shares == kShareEqual) giveEqually(flux, count);
  else giveByWeight(flux, count, weighReceivers(count, radius, giver, push.shares == kShareByDirection));
}
