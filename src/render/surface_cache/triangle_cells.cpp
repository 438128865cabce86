#include "render/surface_cache/triangle_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace importon {
namespace {

constexpr double kMostSubdivisions = 2047;
constexpr double kLongest = 4;         // side of a cell over the root of the area asked for, at most
constexpr double kLeastWorth = 0.25;   // of what is asked for, below which a shared cell becomes part of another
constexpr int kJoinings = 3;           // each by a grid of twice the edge
constexpr double kStepsPerOctave = 2;  // sizes of the cells that small triangles share

/// Subdivisions of a triangle's sides; 0: it shares a cell with others.
double subdivisionsOf(const Piece& piece, double scale) {
  const double cells = piece.area * piece.density * scale;
  if (cells < 0.5) return 0;
  const double byLength = piece.longest * std::sqrt(piece.density * scale) / kLongest;
  return std::clamp(std::ceil(std::max(std::sqrt(cells), byLength)), 1.0, kMostSubdivisions);
}

/// Which of six sides a normal is nearest to, as a vector.
vec3 nearestSide(const vec3& normal) {
  const vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  vec3 side(0.0f);
  side[axis] = normal[axis] < 0 ? -1.0f : 1.0f;
  return side;
}

}  // namespace

Corners cornersOf(const Scene& scene, const Triangle& t) {
  return {scene.positions[t.v0], scene.positions[t.v1], scene.positions[t.v2]};
}

Piece measurePiece(const Corners& p) {
  const auto length = [](const vec3& a, const vec3& b) { return static_cast<double>(glm::distance(a, b)); };
  Piece piece;
  piece.area = 0.5 * static_cast<double>(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
  piece.longest = std::max({length(p[0], p[1]), length(p[1], p[2]), length(p[2], p[0])});
  return piece;
}

std::uint64_t sharedCell(const Corners& p, const vec3& origin, const CellGrid& grid) {
  const double size = std::floor(-0.5 * kStepsPerOctave * std::log2(grid.density));
  const double edge = std::exp2(size / kStepsPerOctave);
  const vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
  const float length = glm::length(n);
  vec3 facing = length > 0 ? n / length : vec3(0);
  if (grid.bins == NormalBins::sixSides) facing = nearestSide(facing);
  std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::int64_t>(size)) * 0x9E3779B97F4A7C15u;
  key ^= key >> 29;
  for (int axis = 0; axis < 3; ++axis) {
    const double at =
        static_cast<double>((p[0][axis] + p[1][axis] + p[2][axis]) / 3 - origin[axis]) / edge + grid.shift;
    const auto part = static_cast<std::uint64_t>(std::clamp(at, 0.0, 1e15)) << 3 |
                      static_cast<std::uint64_t>(std::round(facing[axis] * 1.9f) + 2);
    key = (key ^ part) * 0x9E3779B97F4A7C15u;
    key ^= key >> 29;
  }
  return key;
}

double countCells(const std::vector<Piece>& pieces, double scale) {
  double cells = 0;
  for (const Piece& piece : pieces) {
    const double n = subdivisionsOf(piece, scale);
    cells += n > 0 ? n * n : 1.5 * piece.area * piece.density * scale;
  }
  return cells;
}

namespace {

/// Cells of small triangles.
struct SharedCells {
  std::vector<std::vector<std::uint32_t>> triangles;  // of each
  std::vector<double> worth;                          // its area over that asked for
};

SharedCells gather(std::vector<std::pair<std::uint64_t, std::uint32_t>> small, const std::vector<Piece>& pieces,
                   double scale) {
  SharedCells cells;
  std::sort(small.begin(), small.end());
  for (std::size_t k = 0; k < small.size(); ++k) {
    if (k == 0 || small[k].first != small[k - 1].first) {
      cells.triangles.emplace_back();
      cells.worth.push_back(0);
    }
    const Piece& piece = pieces[small[k].second];
    cells.triangles.back().push_back(small[k].second);
    cells.worth.back() += piece.area * piece.density * scale;
  }
  return cells;
}

/// Cells that are too small become part of the largest of those that have the same key by a coarser grid, which is
/// shifted so that its corners are not those of the last. A photon would make them very bright, and few gather rays
/// would see it.
void joinSmall(SharedCells& cells, const std::vector<Piece>& pieces, double scale, const SharedCell& shared) {
  const auto isSmall = [](double worth) { return worth < kLeastWorth; };
  for (int round = 1; round <= kJoinings; ++round) {
    if (std::none_of(cells.worth.begin(), cells.worth.end(), isSmall)) return;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    for (std::uint32_t cell = 0; cell < cells.worth.size(); ++cell) {
      if (cells.triangles[cell].empty()) continue;
      const std::uint32_t triangle = cells.triangles[cell].front();
      const double density = pieces[triangle].density * scale * std::exp2(-2 * round);
      keyed.emplace_back(shared(triangle, {density, NormalBins::sixSides, 0.5 * (round % 2)}), cell);
    }
    std::sort(keyed.begin(), keyed.end());
    for (auto begin = keyed.begin(); begin != keyed.end();) {
      const auto end = std::find_if(begin, keyed.end(), [&](const auto& each) { return each.first != begin->first; });
      const std::uint32_t largest = std::max_element(begin, end, [&](const auto& a, const auto& b) {
                                      return cells.worth[a.second] < cells.worth[b.second];
                                    })->second;
      for (; begin != end; ++begin) {
        const std::uint32_t cell = begin->second;
        if (cell == largest || !isSmall(cells.worth[cell])) continue;
        std::vector<std::uint32_t>& to = cells.triangles[largest];
        to.insert(to.end(), cells.triangles[cell].begin(), cells.triangles[cell].end());
        cells.worth[largest] += cells.worth[cell];
        cells.triangles[cell].clear();
        cells.worth[cell] = std::numeric_limits<double>::infinity();  // there is none any more
      }
    }
  }
}

}  // namespace

CellNumbers numberCells(const std::vector<Piece>& pieces, double scale, NormalBins bins, const SharedCell& shared) {
  CellNumbers out;
  out.triangles.resize(pieces.size());
  std::vector<std::pair<std::uint64_t, std::uint32_t>> small;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const double n = subdivisionsOf(pieces[i], scale);
    if (n <= 0) {
      small.emplace_back(shared(i, {pieces[i].density * scale, bins}), i);
      continue;
    }
    out.triangles[i] = {out.cells, static_cast<uint>(n)};
    out.cells += static_cast<std::size_t>(n * n);
  }
  SharedCells cells = gather(std::move(small), pieces, scale);
  joinSmall(cells, pieces, scale, shared);
  for (const std::vector<std::uint32_t>& cell : cells.triangles) {
    for (const std::uint32_t triangle : cell) out.triangles[triangle] = {out.cells, 1};
    if (!cell.empty()) ++out.cells;
  }
  return out;
}

}  // namespace importon
