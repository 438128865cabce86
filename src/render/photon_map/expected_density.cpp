#include "render/photon_map/expected_density.h"

#include <algorithm>

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

ExpectedDensity::ExpectedDensity(gpu::Context& context, MapKind kind, std::uint64_t capacity)
    : kind_(kind),
      cells_(context, "expected density",
             std::clamp<std::uint64_t>(capacity / 4, 1u << 12, 1u << 20) * sizeof(PhotonCell)) {}

void ExpectedDensity::count(const Stage& stage, const ImportanceMap& importance) {
  if (!isCleared_) stage.recorder.fill(cells_, kNone);
  isCleared_ = true;
  gpu::BindingTable table = stage.work.table;
  importance.bind(table);
  bind(table);
  overItems(stage, stage.kernels.pilotCount, table, kCounterSelected, PilotCountPush{kind_ == MapKind::global});
}

void ExpectedDensity::bind(gpu::BindingTable& table) const { table.set(kBindingPhotonCells, cells_); }

}  // namespace importon
