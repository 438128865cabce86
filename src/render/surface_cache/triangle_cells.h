/// How triangles are cut into cells of a density that is asked of them.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/scene.h"

namespace importon {

/// A triangle to be cut.
struct Piece {
  double area = 0, longest = 0;  // m², m
  double density = 0;            // asked for, cells/m²
};

using Corners = std::array<vec3, 3>;
[[nodiscard]] Corners cornersOf(const Scene& scene, const Triangle& triangle);
/// Of density 0.
[[nodiscard]] Piece measurePiece(const Corners& corners);

/// How finely the normals of triangles that share a cell are told apart.
enum class NormalBins { fine, sixSides };

struct CellGrid {
  double density = 0;  // cells/m²
  NormalBins bins = NormalBins::fine;
  double shift = 0;  // along each axis, in edges of the grid
};

/// Tells the cell that a small triangle shares: its size and place, counted from `origin`, and the rough direction of
/// its normal.
[[nodiscard]] std::uint64_t sharedCell(const Corners& corners, const vec3& origin, const CellGrid& grid);

/// About how many cells there will be; small triangles meet more of them than their area says.
[[nodiscard]] double countCells(const std::vector<Piece>& pieces, double scale);

/// First cell and n of each triangle, of which it is n² or, with others, one; and how many cells there are.
struct CellNumbers {
  std::vector<uvec2> triangles;
  std::size_t cells = 0;
};
/// Small triangles for which `shared` is the same share a cell; it is asked with `bins`, and with coarser grids to join
/// what is too small.
using SharedCell = std::function<std::uint64_t(std::size_t triangle, const CellGrid& grid)>;
[[nodiscard]] CellNumbers numberCells(const std::vector<Piece>& pieces, double scale, NormalBins bins,
                                      const SharedCell& shared);

}  // namespace importon
