#include "render/photon_map/expected_density.h"

#include <algorithm>

#include "kernels/pilot_count.h"

namespace importon {

ExpectedDensity::ExpectedDensity(gpu::Context& context, MapKind kind, std::uint64_t capacity)
    : kind_(kind),
      cells_(context, "expected density",
             std::clamp<std::uint64_t>(capacity / 4, 1u << 12, 1u << 20) * sizeof(PhotonCell)) {}

void ExpectedDensity::count(const Stage& stage, const ImportanceMap& importance) {
  if (!isCleared_) stage.recorder.fill(cells_, kNone);
  isCleared_ = true;
  overItems<kernels::PilotCount>(stage, kCounterSelected, {.isGlobal = kind_ == MapKind::global}, importance.buffers(),
                                 buffers::PhotonCells{cells_});
}

}  // namespace importon
