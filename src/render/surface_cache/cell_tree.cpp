#include "render/surface_cache/cell_tree.h"

#include <bit>

#include "shared/scene_data.h"

namespace importon {
namespace {

constexpr uint kBlocks[] = {2, 4};  // edges of groups, in steps of a triangle's grid

/// Place in a triangular grid: row by row, each shorter by one.
uint placeOf(uint row, uint column, uint rows) { return row * (2 * rows - row + 1) / 2 + column; }

class Grower {
 public:
  explicit Grower(const SurfaceCells& cells) : cells_(cells), cellCount_(static_cast<uint>(cells.areas.size())) {
    for (const float area : cells.areas) tree_.cells.push_back({kNone, std::bit_cast<uint>(area)});
    tree_.levels.push_back(0);
    for (const std::vector<uvec2>* some : {&cells.triangles, &cells.placedGrids})
      for (const uvec2& triangle : *some)
        if (triangle.y > 1) grids_.push_back(triangle);
    below_.resize(grids_.size());
  }

  CellTree grow() {
    uint edge = 1;
    for (const uint block : kBlocks) {
      for (std::size_t i = 0; i < grids_.size(); ++i)
        if (grids_[i].y > edge) groupTriangle(i, edge, block);
      tree_.levels.push_back(static_cast<uint>(tree_.groups.size()));
      edge = block;
    }
    return std::move(tree_);
  }

 private:
  /// Groups of all cells or, if `inner` > 1, blocks of that edge, in blocks of edge `outer`.
  void groupTriangle(std::size_t triangle, uint inner, uint outer) {
    const uint n = grids_[triangle].y, ratio = outer / inner;
    const uint innerRows = (n - 1) / inner + 1, rows = (n - 1) / outer + 1;
    const uint first = static_cast<uint>(tree_.groups.size());
    for (uint row = 0; row < rows; ++row)
      for (uint column = 0; column < rows - row; ++column) {
        const uint begin = static_cast<uint>(tree_.members.size());
        float area = 0;
        for (uint r = ratio * row; r < std::min(ratio * (row + 1), innerRows); ++r)
          for (uint c = ratio * column; c < ratio * (column + 1) && r + c < innerRows; ++c)
            area += inner == 1 ? addCells(triangle, r, c) : addGroup(below_[triangle] + placeOf(r, c, innerRows));
        tree_.groups.push_back({begin, tree_.members.size(), kNone, std::bit_cast<uint>(area)});
      }
    below_[triangle] = first;
  }

  /// Those of one step of the triangle's grid, an upright one and, but at the end of a row, an inverted one.
  float addCells(std::size_t triangle, uint row, uint column) {
    const auto [first, n] = std::pair(grids_[triangle].x, grids_[triangle].y);
    const uint cell = first + row * (2 * n - row) + 2 * column;
    const uint count = column + row + 1 < n ? 2 : 1;
    for (uint k = 0; k < count; ++k) {
      tree_.members.push_back(cell + k);
      tree_.cells[cell + k].x = static_cast<uint>(tree_.groups.size());
    }
    return static_cast<float>(count) * cells_.areas[cell];
  }

  float addGroup(uint group) {
    tree_.members.push_back(cellCount_ + group);
    tree_.groups[group].z = static_cast<uint>(tree_.groups.size());
    return std::bit_cast<float>(tree_.groups[group].w);
  }

  const SurfaceCells& cells_;
  uint cellCount_;
  CellTree tree_;
  std::vector<uvec2> grids_;  // first cell and n of each divided triangle
  std::vector<uint> below_;   // first group of each of them at the level before
};

}  // namespace

CellTree growCellTree(const SurfaceCells& cells) { return Grower(cells).grow(); }

}  // namespace importon
