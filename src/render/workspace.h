/// Transient device buffers of a pass, and the kernels that work on them.
#pragma once
#include "gpu/buffer.h"
#include "gpu/recorder.h"
#include "render/kernel_set.h"
#include "shared/render_data.h"

namespace importon {

/// How much a pass may hold at once, at most. Room for records and entries is made as they come.
struct WorkspaceSize {
  std::uint64_t slots = 0;    // paths in flight
  std::uint64_t records = 0;  // hits of a photon batch, or importons
  std::uint64_t entries = 0;  // the longest list that is sorted
  bool hasCells = false;      // records know the surface cell that they fell in
  bool hasDifferentials = false;  // of importons
  std::uint64_t lightVoxels = 1;  // that remember which lights reach them
};

/// Buffers that all phases share. `table` has them under their binding numbers.
struct Workspace {
  Workspace(gpu::Context& context, const WorkspaceSize& size);

  gpu::Buffer parameters, counters, dispatches;
  gpu::Buffer rays, hits, shadowRays, shadowHits, shadowLight, paths, eyeVertices, pathLight, queueA, queueB;
  gpu::Buffer keep, blockSums, keysA, keysB, valuesA, valuesB;
  gpu::Buffer recordPoints, records, required, selection, selectedPoints, neighbours, accepted;
  gpu::Buffer recordCells;  // of one item without cells
  gpu::Buffer pathDifferentials, footprints, bounds;  // of one item without differentials
  gpu::Buffer lightsSeen;  // two words per voxel: shaders/lib/light_voxel.glsl
  gpu::Buffer noCells, noCellsOfTriangles;  // stands for an irradiance map where there is none
  gpu::Buffer lookups;       // slots of paths that ask for a map lookup
  gpu::Buffer noSamplePlan;  // stands for one where all pixels have as many paths
  gpu::Buffer noGuide;  // stands for an emission guide where there is none
  gpu::BindingTable table;
  WorkspaceSize size;

  [[nodiscard]] bool hasDifferentials() const { return size.hasDifferentials; }
  [[nodiscard]] std::uint64_t recordRoom() const { return recordPoints.bytes() / sizeof(MapPoint); }
  [[nodiscard]] std::uint64_t entryRoom() const { return keysA.bytes() / sizeof(uint); }
};

/// What every phase needs.
struct Stage {
  gpu::Context& gpu;
  gpu::Recorder& recorder;
  const KernelSet& kernels;
  Workspace& work;
};

/// Gives `buffer` room for `bytes` and keeps its first `kept` ones; tables that it is bound in stay right. Waits for the
/// device.
void resize(const Stage& stage, gpu::Buffer& buffer, std::uint64_t bytes, std::uint64_t kept = 0);

/// As many as to make room for when `needed` is more than there is room for: a quarter more, so that it happens rarely.
[[nodiscard]] std::uint64_t roomFor(std::uint64_t needed, std::uint64_t most);

/// Makes room to sort `entries`. What the lists hold is lost. Waits for the device if there is not enough yet.
void reserveEntries(const Stage& stage, std::uint64_t entries);

/// Room for the records of paths that leave one each at every event, made event by event: how many there will be is not
/// known before. Waits for the device as long as those to come might not fit.
class RecordRoom {
 public:
  /// For `paths` paths that have left none yet.
  RecordRoom(const Stage& stage, std::uint64_t paths) : stage_(stage), paths_(paths) {}
  /// Before an event of the paths that `queue` counts, which is one of at most `events` to come. False: no path is left.
  [[nodiscard]] bool makeRoom(uint queue, std::uint64_t events);

 private:
  const Stage& stage_;
  std::uint64_t paths_, records_ = 0;
  bool isFirst_ = true, isEnough_ = false;
};

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

/// Stable compaction of the `source` entries whose `keep` is 1: `out` receives their indices (takesIndex) or
/// the values of `in` there; `target` their number. `accumulate`, if any, grows by `source`.
void compact(const Stage& stage, uint source, uint target, const gpu::Buffer* in, const gpu::Buffer& out,
             uint accumulate = kNone);

/// Selects the records of which `mask` holds a bit: their indices in work.selection, their number in kCounterSelected.
void selectRecords(const Stage& stage, uint mask);

/// Stable sort of the `source` entries by the `bits` low bits of work.keysA. `order` receives their indices;
/// the sorted keys are in the returned buffer.
const gpu::Buffer& sortByKey(const Stage& stage, uint source, uint bits, const gpu::Buffer& order);

}  // namespace importon
