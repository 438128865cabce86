// Hits that a pilot batch counted in cells of the surfaces, and the probability of storing a hit that follows:
// p = min(1, D_r / D_expected), at least the floor. [Keller and Wald 2000]
#ifndef IMPORTON_BINDINGS_EXPECTED_GLSL
#define IMPORTON_BINDINGS_EXPECTED_GLSL
#include "bindings/importance.glsl"
#include "bindings/photon_cells.glsl"

const float kCellPhotons = 8.0;  // a cell holds at most so many at the required density: counts must say something

/// The cell of a point whose required density in the first pass is `density`, and the mean area of such cells, m².
CellKey expectedCell(vec3 position, vec3 normal, float density, out float area) {
  const uint level = cellLevel(params.gridExtent, normal, density / kCellPhotons);
  const float edge = cellEdge(params.gridExtent, level);
  area = edge * edge / (abs(normal.x) + abs(normal.y) + abs(normal.z));
  return cellKey(position - params.gridOrigin, params.gridExtent, level, directionClass(normal), 0u);
}

/// Hits that the pilot batch counted in a cell. A free cell holds kNone, which is one less than 0.
uint pilotHits(CellKey key) {
  const uint slot = seekCell(key);
  return slot == kNone ? 0u : photonCells[slot].photon + 1u;
}

/// The probability of storing a hit where `required` photons per m² are required and `hits` fell on `area` in a pass.
float storageProbability(float required, float area, uint hits, float floorProbability) {
  return min(1.0, max(floorProbability, required * area / float(max(hits, 1u))));
}

#endif
