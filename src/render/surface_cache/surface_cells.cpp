#include "render/surface_cache/surface_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace importon {
namespace {

constexpr double kMostSubdivisions = 2047;
constexpr double kLongest = 4;              // side of a cell over the root of the area asked for, at most
constexpr double kStepsPerOctave = 2;       // sizes of the cells that small triangles share
constexpr std::size_t kAlwaysRoomFor = 64;  // cells
constexpr int kMostSamples = 12;            // of the density along a triangle's side

struct Piece {
  double area = 0, longest = 0;  // m², m
  double density = 0;            // asked for
};

/// Mean of the density over the triangle, each part weighted by what is asked there: the part that matters decides.
double densityOver(const std::array<vec3, 3>& p, int samples, const std::function<double(vec3)>& density) {
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

std::vector<Piece> measure(const Scene& scene, const std::function<double(vec3)>& density, int threads) {
  const vec3 sides = scene.boundsMax - scene.boundsMin;
  const double step = std::max({sides.x, sides.y, sides.z, 1e-30f}) / 64;
  std::vector<Piece> pieces(scene.triangles.size());
  parallelFor(pieces.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = scene.triangles[i];
      const std::array<vec3, 3> p{scene.positions[t.v0], scene.positions[t.v1], scene.positions[t.v2]};
      const auto length = [&](int a, int b) {
        return static_cast<double>(glm::distance(p[static_cast<std::size_t>(a)], p[static_cast<std::size_t>(b)]));
      };
      Piece& piece = pieces[i];
      piece.area = 0.5 * static_cast<double>(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
      piece.longest = std::max({length(0, 1), length(1, 2), length(2, 0)});
      piece.density = densityOver(p, std::clamp(static_cast<int>(piece.longest / step), 1, kMostSamples), density);
    }
  });
  return pieces;
}

/// Subdivisions of a triangle's sides; 0: it shares a cell with others.
double subdivisionsOf(const Piece& piece, double scale) {
  const double cells = piece.area * piece.density * scale;
  if (cells < 0.5) return 0;
  const double byLength = piece.longest * std::sqrt(piece.density * scale) / kLongest;
  return std::clamp(std::ceil(std::max(std::sqrt(cells), byLength)), 1.0, kMostSubdivisions);
}

/// Tells the cell that a small triangle shares: its size and place, and the rough direction of its normal.
std::uint64_t sharedCell(const Scene& scene, const Triangle& t, double density) {
  const vec3 p0 = scene.positions[t.v0], p1 = scene.positions[t.v1], p2 = scene.positions[t.v2];
  const double size = std::floor(-0.5 * kStepsPerOctave * std::log2(density));
  const double edge = std::exp2(size / kStepsPerOctave);
  const vec3 n = glm::cross(p1 - p0, p2 - p0);
  const float length = glm::length(n);
  const vec3 facing = length > 0 ? n / length : vec3(0);
  std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::int64_t>(size)) * 0x9E3779B97F4A7C15u;
  key ^= key >> 29;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = static_cast<double>((p0[axis] + p1[axis] + p2[axis]) / 3 - scene.boundsMin[axis]) / edge;
    const auto part = static_cast<std::uint64_t>(std::clamp(at, 0.0, 1e15)) << 3 |
                      static_cast<std::uint64_t>(std::round(facing[axis] * 1.9f) + 2);
    key = (key ^ part) * 0x9E3779B97F4A7C15u;
    key ^= key >> 29;
  }
  return key;
}

/// About how many cells there will be; small triangles meet more of them than their area says.
double countCells(const std::vector<Piece>& pieces, double scale) {
  double cells = 0;
  for (const Piece& piece : pieces) {
    const double n = subdivisionsOf(piece, scale);
    cells += n > 0 ? n * n : 1.5 * piece.area * piece.density * scale;
  }
  return cells;
}

SurfaceCells layOut(const Scene& scene, const std::vector<Piece>& pieces, double scale) {
  SurfaceCells out;
  out.triangles.resize(pieces.size());
  std::vector<std::pair<std::uint64_t, std::uint32_t>> small;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const double n = subdivisionsOf(pieces[i], scale);
    if (n <= 0) {
      small.emplace_back(sharedCell(scene, scene.triangles[i], pieces[i].density * scale), i);
      continue;
    }
    out.triangles[i] = {out.areas.size(), static_cast<uint>(n)};
    out.areas.resize(out.areas.size() + static_cast<std::size_t>(n * n), static_cast<float>(pieces[i].area / (n * n)));
  }
  std::sort(small.begin(), small.end());
  for (std::size_t k = 0; k < small.size(); ++k) {
    if (k == 0 || small[k].first != small[k - 1].first) out.areas.push_back(0);
    out.areas.back() += static_cast<float>(pieces[small[k].second].area);
    out.triangles[small[k].second] = {out.areas.size() - 1, 1};
  }
  return out;
}

}  // namespace

SurfaceCells cutSurfaces(const Scene& scene, const std::function<double(vec3)>& density, std::size_t mostCells,
                         int threads) {
  const std::vector<Piece> pieces = measure(scene, density, threads);
  const double most = static_cast<double>(mostCells);
  double scale = 1;
  for (double cells = countCells(pieces, scale); cells > most; cells = countCells(pieces, scale))
    scale *= 0.9 * most / cells;
  for (;;) {
    SurfaceCells cells = layOut(scene, pieces, scale);
    if (cells.areas.size() <= mostCells || cells.areas.size() <= kAlwaysRoomFor) return cells;
    scale *= 0.9 * most / static_cast<double>(cells.areas.size());
  }
}

}  // namespace importon
