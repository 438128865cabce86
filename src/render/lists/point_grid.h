/// A hashed grid over points in device memory (lib/grid.glsl).
#pragma once
#include "render/lists/counters.h"

namespace importon {

struct PointGrid {
  gpu::Buffer cells;   // uvec2 per slot: first point and end, in cell order
  gpu::Buffer points;  // MapPoint in cell order
  gpu::Buffer order;   // their indices before sorting
  uint slotMask = 0;

  PointGrid() = default;
  /// For up to `capacity` points.
  PointGrid(gpu::Context& context, const char* name, std::uint64_t capacity)
      : PointGrid(context, name, capacity, capacity) {}
  /// The same with the cells of a grid of `cellsFor` points.
  PointGrid(gpu::Context& context, const char* name, std::uint64_t capacity, std::uint64_t cellsFor);
  /// Bits of a slot number.
  [[nodiscard]] uint slotBits() const;
  /// How many points it has room for.
  [[nodiscard]] std::uint64_t room() const { return points.bytes() / sizeof(MapPoint); }
  /// Device memory.
  [[nodiscard]] std::uint64_t bytes() const {
    return cells.allocatedBytes() + points.allocatedBytes() + order.allocatedBytes();
  }
};

/// Sorts the points that `source` counts into cells, by the keys in work.keysA; `points` has them unsorted.
void buildGrid(const Stage& stage, PointGrid& grid, uint source, const gpu::Buffer& points);

/// The first two steps of buildGrid: order and cells, without the points.
void sortIntoCells(const Stage& stage, PointGrid& grid, uint source);

/// A grid as the one that lib/grid_search.glsl searches.
struct SearchedGrid {
  explicit SearchedGrid(const PointGrid& grid)
      : storedCells(grid.cells), storedPoints(grid.points), storedOrder(grid.order) {}
  const gpu::Buffer &storedCells, &storedPoints, &storedOrder;
};

}  // namespace importon
