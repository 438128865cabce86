#include "render/lists/point_grid.h"

#include <algorithm>
#include <bit>
#include <string>

#include "kernels/grid_cells.h"
#include "kernels/grid_points.h"
#include "render/lists/lists.h"

namespace importon {
namespace {

/// About one slot per point, as a power of two that sorts in few passes.
std::uint64_t slotCount(std::uint64_t capacity) {
  return std::clamp<std::uint64_t>(std::bit_ceil(capacity), 1u << 12, 1u << 20);
}

}  // namespace

PointGrid::PointGrid(gpu::Context& context, const char* name, std::uint64_t capacity, std::uint64_t cellsFor)
    : cells(context, std::string(name) + " cells", slotCount(cellsFor) * sizeof(uvec2), gpu::TexelFormat::uint2),
      points(context, std::string(name) + " points", capacity * sizeof(MapPoint), gpu::TexelFormat::uint4),
      order(context, std::string(name) + " order", capacity * sizeof(uint), gpu::TexelFormat::uint1),
      slotMask(static_cast<uint>(slotCount(cellsFor) - 1)) {}

uint PointGrid::slotBits() const { return static_cast<uint>(std::popcount(slotMask)); }

void sortIntoCells(const Stage& stage, PointGrid& grid, uint source) {
  const gpu::Buffer& sortedKeys = sortByKey(stage, source, grid.slotBits(), grid.order);
  stage.recorder.fill(grid.cells, 0);
  overItems<kernels::GridCells>(stage, source, {.source = source, .slotMask = grid.slotMask}, buffers::Keys{sortedKeys},
                                buffers::Cells{grid.cells});
}

void buildGrid(const Stage& stage, PointGrid& grid, uint source, const gpu::Buffer& points) {
  sortIntoCells(stage, grid, source);
  overItems<kernels::GridPoints>(stage, source, {.source = source}, buffers::Points{points}, buffers::Order{grid.order},
                                 buffers::PointsOut{grid.points});
}

}  // namespace importon
