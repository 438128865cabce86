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

/// Tells the cell that a small triangle shares: its size and place, counted from `origin`, and the rough direction of
/// its normal.
[[nodiscard]] std::uint64_t sharedCell(const Corners& corners, const vec3& origin, double density, NormalBins bins);

/// About how many cells there will be; small triangles meet more of them than their area says.
[[nodiscard]] double countCells(const std::vector<Piece>& pieces, double scale);

/// First cell and n of each triangle, of which it is n² or, with those for which `shared(triangle, density)` is the
/// same, one; and how many cells there are.
struct CellNumbers {
  std::vector<uvec2> triangles;
  std::size_t cells = 0;
};
[[nodiscard]] CellNumbers numberCells(const std::vector<Piece>& pieces, double scale,
                                      const std::function<std::uint64_t(std::size_t, double)>& shared);

}  // namespace importon
