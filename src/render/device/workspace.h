/// Transient device buffers of a pass, and the kernels that work on them.
#pragma once
#include <functional>

#include "gpu/buffer.h"
#include "gpu/recorder.h"
#include "render/device/kernel_set.h"
#include "render/device_scene/device_scene.h"
#include "render/plan/pass_plan.h"
#include "shared/render_data.h"

namespace importon {

/// Surface cells of the pass at hand, by the names that kernels have for them.
struct CellBuffers {
  std::reference_wrapper<const gpu::Buffer> surfaceCells, placedCells, cellPlaces, cellSums, cellIrradiances;
};

/// Stand for what there is not: guides, a plan of samples, surface cells.
struct StandIns {
  explicit StandIns(gpu::Context& context);

  gpu::Buffer guideRows, guideColumns, environmentGuide, scatterGuides, samplePlan;
  gpu::Buffer surfaceCells, cells;

  [[nodiscard]] CellBuffers noCells() const { return {surfaceCells, surfaceCells, surfaceCells, cells, cells}; }
};

/// Buffers that all phases share, by the names that kernels have for them.
struct Workspace {
  Workspace(gpu::Context& context, const WorkspaceSize& size);
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  gpu::Buffer parameters, counters, dispatches;
  gpu::Buffer rays, hits, shadowRays, shadowHits, shadowLight, paths, eyeVertices, pathLight, queueA, queueB;
  gpu::Buffer keep, blockSums, keysA, keysB, valuesA, valuesB;
  gpu::Buffer recordPoints, records, required, selection, selectedPoints, neighbours, accepted;
  gpu::Buffer recordCells;                            // of one item without cells
  gpu::Buffer pathDifferentials, footprints, bounds;  // of one item without differentials
  gpu::Buffer lightsSeen;                             // two words per voxel: shaders/lib/light_voxel.glsl
  gpu::Buffer lookups;                                // slots of paths that ask for a map lookup
  StandIns standIns;
  CellBuffers cells;
  WorkspaceSize size;

  [[nodiscard]] bool hasDifferentials() const { return size.hasDifferentials; }
  [[nodiscard]] std::uint64_t recordRoom() const { return recordPoints.bytes() / sizeof(MapPoint); }
  [[nodiscard]] std::uint64_t entryRoom() const { return keysA.bytes() / sizeof(uint); }
  /// Entries of blockSums for lists of `compacted` and of `sorted` entries: a sum for each tile, or one for each of its
  /// digits.
  [[nodiscard]] static std::uint64_t blockSumsOf(std::uint64_t compacted, std::uint64_t sorted);
};

/// What every phase needs.
struct Stage {
  gpu::Context& gpu;
  gpu::Recorder& recorder;
  KernelSet& kernels;
  Workspace& work;
  const DeviceScene& scene;
};

}  // namespace importon
