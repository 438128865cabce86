/// The cells of each triangle in groups, and those in larger ones, so that irradiance may be averaged where it does not
/// differ.
#pragma once
#include "render/surface_cache/surface_cells.h"

namespace importon {

/// Nodes are cells, by their number, and groups, by their number plus that of cells. A group's members lie side by
/// side.
struct CellTree {
  std::vector<uvec4> groups;  // first member, their end, group that it is in (kNone: none), area (m², bits of a float)
  std::vector<uint> members;  // nodes
  std::vector<uvec2> cells;   // group that each is in (kNone: none), area
  std::vector<uint> levels;   // first group of each level, and the end: members of a level's groups are of lower levels
};

/// A triangle's cells in blocks of 2 x 2 steps of its barycentric grid, and these in blocks of 2 x 2. Cells that
/// several triangles share stay alone.
[[nodiscard]] CellTree growCellTree(const SurfaceCells& cells);

}  // namespace importon
