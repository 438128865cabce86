// The table of photon cells: a slot for each cell, whatever collides.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "shared/render_data.h"
#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "test_kernels/photon_cells.h"

namespace importon {
namespace {

class PhotonCells : public test::GpuTest {
 protected:
  /// Slots that cells of these keys get in a table of `slots`, all at once.
  std::vector<uint> find(const std::vector<uvec2>& keys, std::size_t slots) {
    const gpu::Kernel kernel(context(), "photon cells", test_kernels::PhotonCells::kCode);
    const std::vector<PhotonCell> empty(slots, PhotonCell{kNone, kNone, kNone});
    const gpu::Buffer table = gpu::makeBuffer(context(), "table", std::span<const PhotonCell>(empty));
    const gpu::Buffer input = gpu::makeBuffer(context(), "keys", std::span<const uvec2>(keys));
    const gpu::Buffer output(context(), "slots", keys.size() * sizeof(uint));
    gpu::Recorder recorder(context());
    namespace buffers = test_kernels::buffers;
    recorder.dispatch(
        kernel,
        test_kernels::PhotonCells::buffers(buffers::PhotonCells{table}, buffers::In{input}, buffers::Out{output}),
        keys.size(), static_cast<std::uint32_t>(keys.size()));
    recorder.submitAndWait();
    return output.download<uint>(keys.size());
  }
};

// Cells that share the first word of their keys, or all but the last slots of the table.
TEST_F(PhotonCells, HaveASlotOfTheirOwnThoughAllCollide) {
  std::vector<uvec2> keys;
  for (uint k = 0; k < 600; ++k) keys.emplace_back(k % 3 == 0 ? 7u : 0xF0000000u + k % 50, 2 * (k % 100));
  const std::vector<uint> slots = find(keys, 256);
  std::map<std::pair<uint, uint>, std::set<uint>> slotsOf;
  std::set<uint> used;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    ASSERT_LT(slots[i], 256u);
    slotsOf[{keys[i].x, keys[i].y}].insert(slots[i]);
    used.insert(slots[i]);
  }
  for (const auto& [key, own] : slotsOf) EXPECT_EQ(own.size(), 1u) << key.first << ", " << key.second;
  EXPECT_EQ(used.size(), slotsOf.size()) << "cells share slots";
}

TEST_F(PhotonCells, FindNoSlotInAFullTable) {
  std::vector<uvec2> keys;
  for (uint k = 0; k < 20; ++k) keys.emplace_back(k, 2 * k);
  const std::vector<uint> slots = find(keys, 16);
  EXPECT_EQ(std::count(slots.begin(), slots.end(), kNone), 4);
}

}  // namespace
}  // namespace importon
