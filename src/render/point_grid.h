/// A hashed grid over points in device memory (lib/grid.glsl).
#pragma once
#include "render/workspace.h"

namespace importon {

struct PointGrid {
  gpu::Buffer cells;   // uvec2 per slot: first point and end, in cell order
  gpu::Buffer points;  // MapPoint in cell order
  gpu::Buffer order;   // their indices before sorting
  uint slotMask = 0;

  PointGrid() = default;
  /// For up to `capacity` points.
  PointGrid(gpu::Context& context, const char* name, std::uint64_t capacity);
  /// Bits of a slot number.
  [[nodiscard]] uint slotBits() const;
};

/// Sorts the points that `source` counts into cells, by the keys in work.keysA; `points` has them unsorted.
void buildGrid(const Stage& stage, PointGrid& grid, uint source, const gpu::Buffer& points);

/// The first two steps of buildGrid: order and cells, without the points.
void sortIntoCells(const Stage& stage, PointGrid& grid, uint source);

/// Binds `grid` as the one that lib/grid_search.glsl searches.
void bindStored(gpu::BindingTable& table, const PointGrid& grid);

}  // namespace importon
