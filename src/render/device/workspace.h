/// Transient device buffers of a pass, and the kernels that work on them.
#pragma once
#include "gpu/buffer.h"
#include "gpu/recorder.h"
#include "render/device/kernel_set.h"
#include "render/plan/pass_plan.h"
#include "shared/render_data.h"

namespace importon {

/// Buffers that all phases share. `table` has them under their binding numbers.
struct Workspace {
  Workspace(gpu::Context& context, const WorkspaceSize& size);

  gpu::Buffer parameters, counters, dispatches;
  gpu::Buffer rays, hits, shadowRays, shadowHits, shadowLight, paths, eyeVertices, pathLight, queueA, queueB;
  gpu::Buffer keep, blockSums, keysA, keysB, valuesA, valuesB;
  gpu::Buffer recordPoints, records, required, selection, selectedPoints, neighbours, accepted;
  gpu::Buffer recordCells;                            // of one item without cells
  gpu::Buffer pathDifferentials, footprints, bounds;  // of one item without differentials
  gpu::Buffer lightsSeen;                             // two words per voxel: shaders/lib/light_voxel.glsl
  gpu::Buffer noCells, noCellsOfTriangles;            // stands for an irradiance map where there is none
  gpu::Buffer lookups;                                // slots of paths that ask for a map lookup
  gpu::Buffer noSamplePlan;                           // stands for one where all pixels have as many paths
  gpu::Buffer noGuide;                                // stands for an emission guide where there is none
  gpu::BindingTable table;
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
  const KernelSet& kernels;
  Workspace& work;
};

}  // namespace importon
