#include "render/surface_cache/placed_cells.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace importon {
namespace {

constexpr double kTogether = 0.5;    // cells of an instance, below which it shares one with those around it
constexpr double kOneCell = 3;       // below which it has one
constexpr double kFineNormals = 24;  // cells of a table, from which on normals are told apart finely
constexpr double kOfOwnLevel = 4;    // cells of a page on average, from which on each page has a level of its own
constexpr double kSpread = 1.5;      // small triangles meet more cells than their area says
constexpr double kSides = 6;

NormalBins binsFor(double cells) { return cells < kFineNormals ? NormalBins::sixSides : NormalBins::fine; }

int levelOf(double density) {
  constexpr double kMost = 200;
  return static_cast<int>(std::lround(std::clamp(std::log2(std::max(density, 1e-300)), -kMost, kMost)));
}

}  // namespace

PlacedCells::PlacedCells(const Scene& scene, const std::function<double(vec3)>& density, int threads)
    : scene_(scene), areas_(scene.placed.pageCount()), wanted_(areas_.size()) {
  parallelFor(scene.placed.instances.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PlacedInstance& instance = scene.placed.instances[i];
      const Placement placement = instance.placement();
      const glm::dmat3 cofactors = placement.cofactors();
      std::size_t at = instance.firstPage;
      for (const MeshPage& page : scene.placed.meshes[instance.mesh].pages) {
        areas_[at] = static_cast<float>(page.areas.areaAfter(cofactors));
        wanted_[at] = static_cast<float>(static_cast<double>(areas_[at]) * density(vec3(placement(page.sample))));
        ++at;
      }
    }
  });
}

double PlacedCells::wanted(const PlacedInstance& instance, double scale) const {
  double sum = 0;
  const std::size_t pages = scene_.placed.meshes[instance.mesh].pages.size();
  for (std::size_t i = 0; i < pages; ++i) sum += static_cast<double>(wanted_[instance.firstPage + i]);
  return sum * scale;
}

double PlacedCells::count(double scale) const {
  double cells = 0;
  for (const PlacedInstance& instance : scene_.placed.instances) {
    const auto pages = static_cast<double>(scene_.placed.meshes[instance.mesh].pages.size());
    const double own = wanted(instance, scale);
    cells += own < kTogether ? kSpread * own : own < kOneCell ? 1 : kSpread * own;
    if (own >= kOneCell) cells += own < kOfOwnLevel * pages ? kSides : pages;
  }
  return cells;
}

PlacedCells::Table& PlacedCells::table(const Key& key) {
  const auto [entry, isNew] = tables_.try_emplace(key);
  Table& table = entry->second;
  if (!isNew) return table;
  const auto [meshIndex, page, level, bins] = key;
  const PlacedMesh& mesh = scene_.placed.meshes[meshIndex];
  const uint begin = page == kNone ? 0 : page * kPageTriangles;
  const uint end = page == kNone ? mesh.triangleCount : std::min(begin + kPageTriangles, mesh.triangleCount);
  const auto corners = [&, first = mesh.firstTriangle + begin](std::size_t i) {
    return cornersOf(scene_, scene_.triangles[first + i]);
  };
  vec3 low = mesh.pages.front().low;
  for (const MeshPage& each : mesh.pages) low = glm::min(low, each.low);
  std::vector<Piece> pieces(end - begin);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i] = measurePiece(corners(i));
    pieces[i].density = std::exp2(level);
  }
  CellNumbers numbers = numberCells(
      pieces, 1, bins, [&](std::size_t i, const CellGrid& grid) { return sharedCell(corners(i), low, grid); });
  table.cells.resize(numbers.cells);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto [first, n] = std::pair(numbers.triangles[i].x, numbers.triangles[i].y);
    const Corners p = corners(i);
    AreaTensor part;
    const float side = 1.0f / static_cast<float>(n);
    part.add(p[0], p[0] + side * (p[1] - p[0]), p[0] + side * (p[2] - p[0]));
    for (std::size_t k = 0; k < std::size_t{n} * n; ++k) table.cells[first + k].add(part);
    if (n > 1) table.grids.push_back(numbers.triangles[i]);
  }
  table.triangles = std::move(numbers.triangles);
  return table;
}

uint PlacedCells::place(Table& table, const glm::dmat3& cofactors, SurfaceCells& out) const {
  if (table.place == kNone) {
    table.place = static_cast<uint>(out.placed.size());
    out.placed.insert(out.placed.end(), table.triangles.begin(), table.triangles.end());
  }
  const auto first = static_cast<uint>(out.areas.size());
  for (const AreaTensor& cell : table.cells) out.areas.push_back(static_cast<float>(cell.areaAfter(cofactors)));
  for (const uvec2& grid : table.grids) out.placedGrids.emplace_back(first + grid.x, grid.y);
  return first;
}

/// One cell for the instance, or for all around it that are as unimportant.
uint PlacedCells::placeTogether(const PlacedInstance& instance, double wanted, SurfaceCells& out) {
  const PlacedMesh& mesh = scene_.placed.meshes[instance.mesh];
  double area = 0;
  for (std::size_t i = 0; i < mesh.pages.size(); ++i) area += static_cast<double>(areas_[instance.firstPage + i]);
  auto cell = static_cast<uint>(out.areas.size());
  if (wanted < kTogether) {
    const vec3 at = instance.placement()(mesh.pages.front().sample);
    const std::uint64_t key =
        sharedCell({at, at, at}, scene_.boundsMin, {std::max(wanted, 1e-30) / area, NormalBins::sixSides});
    cell = together_.try_emplace(key, cell).first->second;
  }
  if (cell == out.areas.size()) out.areas.push_back(0);
  out.areas[cell] += static_cast<float>(area);
  return cell;
}

void PlacedCells::layOutPage(const PlacedInstance& instance, uint page, double scale, SurfaceCells& out) {
  const uint at = instance.firstPage + page;
  const MeshPage& own = scene_.placed.meshes[instance.mesh].pages[page];
  const double wanted = scale * static_cast<double>(wanted_[at]);
  if (wanted < 1) {
    out.placed[at].x = static_cast<uint>(out.areas.size());
    out.areas.push_back(areas_[at]);
    return;
  }
  Table& cut = table({instance.mesh, page, levelOf(wanted / own.areas.area()), binsFor(wanted)});
  out.placed[at].x = place(cut, instance.placement().cofactors(), out);
  out.placed[at].y = cut.place;
}

void PlacedCells::layOutInstance(const PlacedInstance& instance, double wanted, double scale, SurfaceCells& out) {
  const PlacedMesh& mesh = scene_.placed.meshes[instance.mesh];
  const auto pages = static_cast<uint>(mesh.pages.size());
  if (wanted >= kOfOwnLevel * pages) {
    for (uint page = 0; page < pages; ++page) layOutPage(instance, page, scale, out);
    return;
  }
  if (wanted < kOneCell) {
    const uint cell = placeTogether(instance, wanted, out);
    for (uint page = 0; page < pages; ++page) out.placed[instance.firstPage + page].x = cell;
    return;
  }
  double area = 0;
  for (const MeshPage& page : mesh.pages) area += page.areas.area();
  Table& cut = table({instance.mesh, kNone, levelOf(wanted / area), binsFor(wanted)});
  const uint first = place(cut, instance.placement().cofactors(), out);
  for (uint page = 0; page < pages; ++page)
    out.placed[instance.firstPage + page] = {first, cut.place + page * kPageTriangles};
}

void PlacedCells::layOut(double scale, SurfaceCells& out) {
  if (scene_.placed.isEmpty()) return;
  // After the pages, a table of one cell.
  const auto pages = static_cast<uint>(wanted_.size());
  out.placed.assign(pages, uvec2(0, pages));
  out.placed.resize(pages + kPageTriangles, uvec2(0, 1));
  for (auto& [key, table] : tables_) table.place = kNone;
  together_.clear();
  for (const PlacedInstance& instance : scene_.placed.instances)
    layOutInstance(instance, wanted(instance, scale), scale, out);
}

}  // namespace importon
