#version 460
// Adds the flux of photon hits to the surface cells that they fell in: exact, and the same in any order. Flux becomes
// whole units at random, up or down with the right mean, so that light of less than a unit a photon is not lost.
#extension GL_GOOGLE_include_directive : require
#include "bindings/records.glsl"
#include "lib/flux.glsl"
#include "lib/hash.glsl"

layout(scalar) readonly buffer RecordCellsBlock { uvec2 recordCells[]; };
layout(scalar) buffer CellSumsBlock { uint irradiance[]; };
layout(scalar) buffer TotalsBlock { uint totals[]; };  // of all hits: 3 channels of 2 words

void main() {
  const uint tile = invocationIndex();
  const uint count = counters[kCounterRecords];
  const uint begin = tile * kTileSize, end = min(begin + kTileSize, count);
  if (begin >= count) return;
  uvec2 sums[3] = uvec2[3](uvec2(0u), uvec2(0u), uvec2(0u));
  uint hits = 0u, lit = 0u;
  for (uint i = begin; i < end; ++i) {
    if ((records[i].kind & kRecordGlobal) == 0u) continue;
    const uvec2 cell = recordCells[i];
    const uint random = hashCombine(params.pass, records[i].kind);
    const vec3 units = records[i].flux * (uintBitsToFloat(cell.y) * params.irradianceUnits);
    const uint at = 8u * cell.x;
    for (uint c = 0u; c < 3u; ++c) {
      const uvec2 add = fixedFromFloat(units[c] + unitFloat(hash(random + c)));
      const uint before = atomicAdd(irradiance[at + 2u * c], add.x);
      const uint high = add.y + uint(before + add.x < before);
      if (high != 0u) atomicAdd(irradiance[at + 2u * c + 1u], high);
      sums[c] = addFixed(sums[c], add);
    }
    const vec3 small = units * params.photonUnits;
    atomicAdd(irradiance[at + 7u], uint(min(dot(small, small), 65536.0) + unitFloat(hash(random + 3u))));
    lit += uint(atomicAdd(irradiance[at + 6u], 1u) == 0u);
    ++hits;
  }
  if (hits == 0u) return;
  for (uint c = 0u; c < 3u; ++c) {
    const uint before = atomicAdd(totals[2u * c], sums[c].x);
    const uint high = sums[c].y + uint(before + sums[c].x < before);
    if (high != 0u) atomicAdd(totals[2u * c + 1u], high);
  }
  const uint hitsBefore = atomicAdd(counters[kSumCellHits], hits);
  if (hitsBefore + hits < hitsBefore) atomicAdd(counters[kSumCellHits + 1u], 1u);
  atomicAdd(counters[kCounterCellsLit], lit);
}
