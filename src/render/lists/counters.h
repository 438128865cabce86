/// Counters in device memory, and dispatches over what they count.
#pragma once
#include <span>
#include <type_traits>

#include "render/device/kernel_variants.h"
#include "render/device/workspace.h"

namespace importon {

namespace buffers = kernels::buffers;

/// Push constants as bytes.
template <class Push>
[[nodiscard]] std::span<const std::byte> bytesOf(const Push& push) {
  if constexpr (std::is_empty_v<Push>)
    return {};
  else
    return std::as_bytes(std::span(&push, 1));
}

/// The buffers that a kernel takes: each from the first that has one of its name, of `owners`, the workspace and the
/// scene.
template <class Call, class... Owners>
[[nodiscard]] auto buffersOf(const Stage& stage, const Owners&... owners) {
  return Call::buffers(owners..., stage.work, stage.work.cells, stage.work.standIns, stage.scene);
}

/// Runs a kernel in `invocations`.
template <class Call, class... Owners>
void run(const Stage& stage, std::uint64_t invocations, const typename Call::Push& push, const Owners&... owners) {
  stage.recorder.dispatch(stage.kernels.get<Call>(), buffersOf<Call>(stage, owners...), invocations, bytesOf(push));
}

/// The same with as many workgroups as stand `offset` bytes into the dispatch arguments of what `counter` counts.
template <class Call, class... Owners>
void runOver(const Stage& stage, uint counter, std::size_t offset, const typename Call::Push& push,
             const Owners&... owners) {
  stage.recorder.dispatchIndirect(stage.kernels.get<Call>(), buffersOf<Call>(stage, owners...), stage.work.dispatches,
                                  counter * sizeof(DispatchArguments) + offset, bytesOf(push));
}

/// Over what `counter` counts: one invocation per item, or per tile of kTileSize items, or as many as trace a queue of
/// rays.
template <class Call, class... Owners>
void overItems(const Stage& stage, uint counter, const typename Call::Push& push, const Owners&... owners) {
  runOver<Call>(stage, counter, offsetof(DispatchArguments, items), push, owners...);
}
template <class Call, class... Owners>
void overTiles(const Stage& stage, uint counter, const typename Call::Push& push, const Owners&... owners) {
  runOver<Call>(stage, counter, offsetof(DispatchArguments, tiles), push, owners...);
}

/// Traces the rays of a queue, by the kernel for scenes with holes or for others.
template <class Opaque, class Alpha, class... Owners>
void overRays(const Stage& stage, uint counter, const Owners&... owners) {
  constexpr std::size_t kRays = offsetof(DispatchArguments, rays);
  if (stage.kernels.hasAlpha())
    runOver<Alpha>(stage, counter, kRays, {.source = counter}, owners...);
  else
    runOver<Opaque>(stage, counter, kRays, {.source = counter}, owners...);
}
/// To their nearest hits, or to anything in their way. The rays are the workspace's unless `owners` have others.
template <class... Owners>
void traceClosest(const Stage& stage, uint counter, const Owners&... owners) {
  overRays<kernels::TraceClosest, kernels::TraceClosestAlpha>(stage, counter, owners...);
}
/// Of rays that pass panes, dims the light that `owners` have as shadowLight.
template <class... Owners>
void traceShadow(const Stage& stage, uint counter, const Owners&... owners) {
  if (stage.kernels.hasPanes())
    return overRays<kernels::TraceShadowPanes, kernels::TraceShadowPanes>(stage, counter, owners...);
  overRays<kernels::TraceShadow, kernels::TraceShadowAlpha>(stage, counter, owners...);
}

/// counters[counter] = min(value + counters[a] + counters[b], limit)
void setCounter(const Stage& stage, uint counter, uint value, uint a = kNone, uint b = kNone, uint limit = kNone);

/// False if a queue of paths has run empty by their event `depth`, so that nothing more need be launched for them. Asks
/// the device, and waits for it, at every second event.
[[nodiscard]] bool anyIsAlive(const Stage& stage, uint queue, uint depth);

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

/// Throws DeviceError if the device has ended lookups too early: so many, as kCounterLookupsUnfinished says.
void checkLookups(uint unfinished);

}  // namespace importon
