/// Surface cells of placed meshes, without a word for each placed triangle: how a page of a mesh is cut, at one of few
/// levels of density, is a table that all its instances share, and each place of a page has a level and cells of its
/// own.
#pragma once
#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "render/surface_cache/surface_cells.h"
#include "render/surface_cache/triangle_cells.h"

namespace importon {

class PlacedCells {
 public:
  /// `density`, cells/m², is asked at a point of each page of each instance, from up to `threads` threads.
  PlacedCells(const Scene& scene, const std::function<double(vec3)>& density, int threads);

  /// About how many cells there will be.
  [[nodiscard]] double count(double scale) const;
  /// Appends the cells.
  void layOut(double scale, SurfaceCells& out);

 private:
  /// Mesh, page (kNone: all of it, pages sharing cells), level (the density is 2^level in object space), bins.
  using Key = std::tuple<uint, uint, int, NormalBins>;
  struct Table {
    std::vector<uvec2> triangles, grids;
    std::vector<AreaTensor> cells;  // object space
    uint place = kNone;             // in SurfaceCells::placed, once it is there
  };

  Table& table(const Key& key);
  [[nodiscard]] double wanted(const PlacedInstance& instance, double scale) const;
  void layOutInstance(const PlacedInstance& instance, double wanted, double scale, SurfaceCells& out);
  void layOutPage(const PlacedInstance& instance, uint page, double scale, SurfaceCells& out);
  /// The table's cells for one place of it. Returns the first.
  [[nodiscard]] uint place(Table& table, const glm::dmat3& cofactors, SurfaceCells& out) const;
  [[nodiscard]] uint placeTogether(const PlacedInstance& instance, double wanted, SurfaceCells& out);

  const Scene& scene_;
  std::vector<float> areas_;   // m² of each page as it is placed
  std::vector<float> wanted_;  // cells of it
  std::map<Key, Table> tables_;
  std::map<std::uint64_t, uint> together_;  // cells that instances share
};

}  // namespace importon
