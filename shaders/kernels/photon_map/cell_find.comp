#version 460
// Required density at each hit of the map at work, and the cell that follows; in cells without a photon the hit of
// least rank will be stored. Counts the hits near each importon, for the passes to come.
#extension GL_GOOGLE_include_directive : require
#include "bindings/importance.glsl"
#include "bindings/photon_cells.glsl"
#include "bindings/selection.glsl"
#include "lib/features.glsl"
#include "lib/seen_light.glsl"

layout(constant_id = kSpecIsDirectional) const bool kIsDirectional = false;
layout(scalar) writeonly buffer HomesBlock { uint homes[]; };
layout(scalar) buffer ImportonHitsBlock { uint hitsOut[]; };
layout(push_constant, scalar) uniform Push {
  uint isGlobal;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[kCounterSelected]) return;
  const MapPoint point = recordPoints[selection[i]];
  const uint kind = records[selection[i]].kind;
  MapSettings map = params.causticMap;
  if (push.isGlobal != 0u) map = params.globalMap;
  const vec3 normal = mapPointNormal(point.packed);
  const NearImportons importons = importonsAt(importonFrame(), map.importonLevels, point.position, normal);
  if (importons.nearest != kNone && params.pass < kCountingPasses) atomicAdd(hitsOut[importons.nearest], 1u);
  float density = requiredDensityAt(map, importons.first);
  if (kIsDirectional && push.isGlobal == 0u && (kind & kRecordGlossy) != 0u && importons.first != kNone)
    density *= seenShare(mapPointDirection(importonPoint(importons.first).w), mapPointDirection(point.packed), normal);
  uint lightClass = (kind & kRecordGlossy) != 0u ? 1u + directionClass(mapPointDirection(point.packed)) : 0u;
  if (kHasDiffuseTransmission && dot(mapPointDirection(point.packed), normal) < 0.0) lightClass += kLightClasses;
  const uint level = cellLevel(params.gridExtent, normal, density);
  const uint slot = findCell(
      cellKey(point.position - params.gridOrigin, params.gridExtent, level, directionClass(normal), lightClass));
  if (slot != kNone) atomicMin(photonCells[slot].photon, kCellClaim | (kind >> kRecordRankShift));
  homes[i] = slot;
  selectedPoints[i] = point;
}
