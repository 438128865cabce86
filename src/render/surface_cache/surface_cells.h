/// All surfaces cut into cells of known area, sized by a density that is asked of them.
#pragma once
#include <functional>

#include "scene/scene.h"

namespace importon {

/// A triangle is a grid of n² equal cells, or, together with small ones around it, one cell:
/// shaders/lib/surface_cell.glsl.
struct SurfaceCells {
  std::vector<uvec2> triangles;  // of the world: first cell, n
  /// Of placed triangles: for each page, the first cell and where in this list its table begins; then the tables, which
  /// have for each triangle of a page the first cell, counted from the page's, and n. Pages of many instances share a
  /// table.
  std::vector<uvec2> placed;
  std::vector<uvec2> placedGrids;  // first cell, n > 1 of those of them that have several cells
  std::vector<float> areas;        // m², of one side, by cell
};

/// Cuts the scene so that 1 / area is about `density(position)` (cells/m², positive), and there are no more than
/// `mostCells` (at least 64) cells: if need be the density asked for is scaled down. `density` is called from up to
/// `threads` threads.
[[nodiscard]] SurfaceCells cutSurfaces(const Scene& scene, const std::function<double(vec3)>& density,
                                       std::size_t mostCells, int threads);

}  // namespace importon
