/// Counters in device memory, and dispatches over what they count.
#pragma once
#include "render/device/workspace.h"

namespace importon {

/// Dispatches over what `counter` counts: one invocation per item, or per tile of kTileSize items, or as many as
/// trace a queue of rays.
template <class Push>
void overItems(const Stage& stage, const gpu::Kernel& kernel, const gpu::BindingTable& table, uint counter,
               const Push& push) {
  stage.recorder.dispatchIndirect(kernel, table, stage.work.dispatches, counter * sizeof(DispatchArguments), push);
}
inline void overItems(const Stage& stage, const gpu::Kernel& kernel, const gpu::BindingTable& table, uint counter) {
  stage.recorder.dispatchIndirect(kernel, table, stage.work.dispatches, counter * sizeof(DispatchArguments));
}
template <class Push>
void overTiles(const Stage& stage, const gpu::Kernel& kernel, const gpu::BindingTable& table, uint counter,
               const Push& push) {
  stage.recorder.dispatchIndirect(kernel, table, stage.work.dispatches,
                                  counter * sizeof(DispatchArguments) + offsetof(DispatchArguments, tiles), push);
}
inline void overTiles(const Stage& stage, const gpu::Kernel& kernel, const gpu::BindingTable& table, uint counter) {
  stage.recorder.dispatchIndirect(kernel, table, stage.work.dispatches,
                                  counter * sizeof(DispatchArguments) + offsetof(DispatchArguments, tiles));
}
template <class Push>
void overRays(const Stage& stage, const gpu::Kernel& kernel, const gpu::BindingTable& table, uint counter,
              const Push& push) {
  stage.recorder.dispatchIndirect(kernel, table, stage.work.dispatches,
                                  counter * sizeof(DispatchArguments) + offsetof(DispatchArguments, rays), push);
}

/// counters[counter] = min(value + counters[a] + counters[b], limit)
void setCounter(const Stage& stage, uint counter, uint value, uint a = kNone, uint b = kNone, uint limit = kNone);

/// Adds counters[counter] to the sum of two words at `sum`, and empties the counter if so asked.
void addCounter(const Stage& stage, uint counter, uint sum, bool empties = false);
/// The sum of two words at `sum` among the counters that were read back.
[[nodiscard]] inline std::uint64_t sumOf(std::span<const uint> counters, uint sum) {
  return counters[sum] | std::uint64_t{counters[sum + 1]} << 32;
}

/// Of a device that is done with what was recorded.
[[nodiscard]] inline uint readCounter(const Stage& stage, uint counter) {
  return stage.work.counters.download<uint>(1, counter * sizeof(uint)).front();
}

}  // namespace importon
