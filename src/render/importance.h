/// Importance maps: importons, and importance at each from its nearest ones.
#pragma once
#include <vector>

#include "render/point_grid.h"

namespace importon {

/// The two maps of the method (kRecordCaustic, kRecordGlobal).
enum class MapKind { caustic, global };

[[nodiscard]] inline uint recordMask(MapKind kind) {
  return kind == MapKind::caustic ? kRecordCaustic : kRecordGlobal;
}

/// Every so-manieth importon (kImportonsPerSite) in cells, with importance Γ (pixels/m²) from all of them at each.
struct ImportanceMap {
  PointGrid grid;
  gpu::Buffer importance;  // float per site, in cell order
  gpu::Buffer bound;       // the same by path differentials; empty: without
  gpu::Buffer hits;        // uint per site: photon hits near it in all passes so far
  uint levels = 0;         // grid levels in use, a bit each
  std::uint64_t count = 0;  // importons

  void bind(gpu::BindingTable& table) const;
  /// The sites, render space; each stands for kImportonsPerSite importons.
  [[nodiscard]] std::vector<MapPoint> readPoints() const;
  [[nodiscard]] std::uint64_t sites() const { return (count + kImportonsPerSite - 1) / kImportonsPerSite; }
};

struct ImportanceMaps {
  ImportanceMap caustic, global;
};

/// Makes empty maps for up to `importons` importons.
[[nodiscard]] ImportanceMaps makeImportanceMaps(gpu::Context& context, std::uint64_t importons, bool hasDifferentials);

/// Traces `importons` importons and builds both maps anew, twice: the first round takes every gather segment for
/// long enough, the second one knows where the global map is read. `nearest` is M of the talk. Sets
/// parameters.causticMap.importonLevels and that of the global map. Waits for the device.
void buildImportance(const Stage& stage, Parameters& parameters, ImportanceMaps& maps, std::uint32_t importons,
                     uint nearest, bool needsCausticMap);

}  // namespace importon
