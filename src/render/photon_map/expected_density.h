/// How many hits a pass will bring where, counted with photons of their own before the first pass: what storage by
/// probability compares the required density with. [Keller and Wald 2000]
#pragma once
#include "render/importance/importance.h"

namespace importon {

class ExpectedDensity {
 public:
  /// For a map of up to `capacity` photons. Where the table of cells is full, hits are stored with certainty.
  ExpectedDensity(gpu::Context& context, MapKind kind, std::uint64_t capacity);

  /// Counts the selected records of the workspace. Over all batches there must be a pass's photons.
  void count(const Stage& stage, const ImportanceMap& importance);
  [[nodiscard]] const gpu::Buffer& cells() const { return cells_; }
  /// Device memory.
  [[nodiscard]] std::uint64_t bytes() const { return cells_.allocatedBytes(); }

 private:
  MapKind kind_;
  gpu::Buffer cells_;
  bool isCleared_ = false;
};

}  // namespace importon
