/// The global photon map in cells of known area: of all photons that fall in a cell the first one takes a record, and
/// the power of the others goes to it. A gather ray reads the record of the cell that it meets, so no light is lost at
/// edges, and what all passes brought counts. Cells are smaller than their photons are many: neighbours share theirs
/// where they do not differ by more than noise. [Arvo 1986, Heckbert 1990; Christensen 1999]
#pragma once
#include "render/photon_map/photon_map.h"
#include "render/surface_cache/cell_tree.h"
#include "render/surface_cache/surface_cells.h"

namespace importon {

class IrradianceMap {
 public:
  /// `units`: of fixed-point flux per W, few enough that all passes together do not overflow.
  /// `firstPass`: before it the map is empty.
  IrradianceMap(gpu::Context& context, const SurfaceCells& cells, float units, int firstPass);

  /// With the half of `pass`, for photons and for reading. Passes go to the halves in turn.
  [[nodiscard]] CellBuffers cells(int pass) const {
    return {tables_.triangles, tables_.placed, places_, halves_[half(pass)], irradiance_};
  }
  /// Adds the batch of hits in the workspace's records to the half of the workspace's cells.
  void addBatch(const Stage& stage) const;
  /// Makes what gather rays read of the half of the workspace's cells: irradiance averaged over groups of cells,
  /// as far as photons do not show that it differs.
  void smooth(const Stage& stage) const;
  [[nodiscard]] int firstPass() const { return firstPass_; }
  /// Says that the photons of all passes from the first one to before `end` are in the map.
  void setPasses(int end) { passes_ = end - firstPass_; }
  /// W per unit of flux in the half of `pass` once that pass is in it, so that it stands for one pass.
  [[nodiscard]] float scale(int pass) const {
    const int passesInHalf = (pass - firstPass_) / 2 + 1;
    return 1 / (units_ * static_cast<float>(passesInHalf));
  }
  /// Flux of an average pass, of its hits and in the cells.
  [[nodiscard]] PhotonMapCounts readFlux() const;
  /// What lasts from pass to pass.
  [[nodiscard]] std::vector<gpu::Buffer*> memory();
  /// Device memory of all that the map holds.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  IrradianceMap(gpu::Context& context, const SurfaceCells& cells, const CellTree& tree, float units, int firstPass);
  static std::size_t half(int pass) { return static_cast<std::size_t>(pass % 2); }
  float units_;
  int firstPass_, passes_ = 0;
  std::vector<uint> levels_;                                         // of groups, as in CellTree
  gpu::Buffer groups_, members_, places_, groupLight_, irradiance_;  // irradiance: what is read
  /// Cells of triangles of the world, and of pages of placed meshes.
  struct CellTables {
    gpu::Buffer triangles, placed;
  } tables_;
  gpu::Buffer totals_;
  std::array<gpu::Buffer, 2> halves_;
};

}  // namespace importon
