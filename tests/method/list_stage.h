/// A workspace with the kernels of lists and grids alone, for testing these without a scene.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "render/lists/lists.h"
#include "render/lists/point_grid.h"
#include "render/lists/room.h"
#include "support/gpu_test.h"

namespace importon::test {

/// Tests on lists of up to `kMaxEntries` entries.
class ListTest : public GpuTest {
 protected:
  static constexpr std::uint64_t kMaxEntries = 1'000'000;

  void SetUp() override;
  void TearDown() override;

  [[nodiscard]] const Stage& stage() { return *stage_; }
  [[nodiscard]] Workspace& work() { return *work_; }
  /// Sets counter `kCounterEntries`, which the tests use for the length of the list at work.
  void setEntries(std::size_t count);
  [[nodiscard]] uint counter(uint which) const;

 private:
  std::optional<KernelSet> kernels_;
  DeviceScene scene_;  // of nothing
  std::optional<Workspace> work_;
  std::optional<gpu::Recorder> recorder_;
  std::optional<Stage> stage_;
};

/// The first `count` numbers of `buffer`.
[[nodiscard]] inline std::vector<uint> numbers(const gpu::Buffer& buffer, std::size_t count) {
  return buffer.download<uint>(count);
}

}  // namespace importon::test
