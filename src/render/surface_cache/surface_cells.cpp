#include "render/surface_cache/surface_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "render/surface_cache/placed_cells.h"
#include "render/surface_cache/triangle_cells.h"

namespace importon {
namespace {

constexpr std::size_t kAlwaysRoomFor = 64;  // cells
constexpr int kMostSamples = 12;            // of the density along a triangle's side

/// Mean of the density over the triangle, each part weighted by what is asked there: the part that matters decides.
double densityOver(const Corners& p, int samples, const std::function<double(vec3)>& density) {
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    for (int j = 0; j < samples - i; ++j) {
      const float u = (static_cast<float>(i) + 1.0f / 3) / static_cast<float>(samples);
      const float v = (static_cast<float>(j) + 1.0f / 3) / static_cast<float>(samples);
      const double d = density(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]));
      sum += d;
      squares += d * d;
    }
  }
  return squares / sum;
}

/// Of the world.
std::vector<Piece> measure(const Scene& scene, const std::function<double(vec3)>& density, int threads) {
  const vec3 sides = scene.boundsMax - scene.boundsMin;
  const double step = std::max({sides.x, sides.y, sides.z, 1e-30f}) / 64;
  std::vector<Piece> pieces(scene.worldTriangleCount());
  parallelFor(pieces.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Corners corners = cornersOf(scene, scene.triangles[i]);
      Piece& piece = pieces[i];
      piece = measurePiece(corners);
      piece.density =
          densityOver(corners, std::clamp(static_cast<int>(piece.longest / step), 1, kMostSamples), density);
    }
  });
  return pieces;
}

SurfaceCells layOutWorld(const Scene& scene, const std::vector<Piece>& pieces, double scale) {
  const auto shared = [&](std::size_t i, const CellGrid& grid) {
    return sharedCell(cornersOf(scene, scene.triangles[i]), scene.boundsMin, grid);
  };
  CellNumbers numbers = numberCells(pieces, scale, NormalBins::fine, shared);
  SurfaceCells out;
  out.areas.resize(numbers.cells);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto [first, n] = std::pair(numbers.triangles[i].x, std::size_t{numbers.triangles[i].y});
    if (n == 1)
      out.areas[first] += static_cast<float>(pieces[i].area);
    else
      std::fill_n(out.areas.begin() + first, n * n, static_cast<float>(pieces[i].area / static_cast<double>(n * n)));
  }
  out.triangles = std::move(numbers.triangles);
  return out;
}

}  // namespace

SurfaceCells cutSurfaces(const Scene& scene, const std::function<double(vec3)>& density, std::size_t mostCells,
                         int threads) {
  const std::vector<Piece> pieces = measure(scene, density, threads);
  PlacedCells placed(scene, density, threads);
  const auto count = [&](double scale) { return countCells(pieces, scale) + placed.count(scale); };
  const double most = static_cast<double>(mostCells);
  double scale = 1;
  for (double cells = count(scale); cells > most; cells = count(scale)) scale *= 0.9 * most / cells;
  for (;;) {
    SurfaceCells cells = layOutWorld(scene, pieces, scale);
    placed.layOut(scale, cells);
    if (cells.areas.size() <= mostCells || cells.areas.size() <= kAlwaysRoomFor) return cells;
    scale *= 0.9 * most / static_cast<double>(cells.areas.size());
  }
}

}  // namespace importon
