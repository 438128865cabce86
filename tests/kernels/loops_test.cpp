// Values that leave loops, where each lane leaves in a turn of its own: SwiftShader loses those that no phi keeps
// (close_loops.h), and so does lavapipe where they come from storage buffers.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

using Result = std::array<std::uint32_t, 4>;

/// As in loops.comp.
struct Push {
  std::uint32_t count, turn;
};

class Loops : public test::GpuTest {
 protected:
  static constexpr std::uint32_t kCount = 1000;

  Loops() : items_(kCount) { std::iota(items_.begin(), items_.end(), 1u); }

  [[nodiscard]] std::uint32_t read(std::uint32_t x) const { return items_[x % kCount]; }

  static std::uint32_t collatz(std::uint32_t x) { return x % 2 == 0 ? x / 2 : 3 * x + 1; }

  /// Steps, what was read last, the number after it, and 1.
  [[nodiscard]] Result steps(std::uint32_t x) const {
    for (std::uint32_t n = 1;; ++n) {
      const std::uint32_t last = read(x);
      const bool isOver = x == 1;
      x = collatz(x);
      if (isOver) return {n, last, x, 1};
    }
  }

  [[nodiscard]] Result queue(std::uint32_t index) const {
    Result sum{};
    for (std::uint32_t taken = 0; taken < 5; ++taken) {
      const Result one = steps(items_[(index + 7 * taken) % kCount]);
      const Result added{one[0], one[1], one[2], one[1]};
      for (std::size_t i = 0; i < 4; ++i) sum[i] += added[i];
    }
    return sum;
  }

  std::vector<std::uint32_t> items_;
};

TEST_F(Loops, LanesKeepWhatTheyHadWhenTheyLeft) {
  const gpu::Kernel kernel(context(), "loops", test_kernels::code("loops"));
  const gpu::Buffer in = gpu::makeBuffer(context(), "items", std::span<const std::uint32_t>(items_));
  const gpu::Buffer out(context(), "results", 2 * kCount * sizeof(Result));
  const gpu::Buffer* const bindings[] = {&in, &out};
  gpu::Recorder recorder(context());
  recorder.dispatch(kernel, bindings, kCount, Push{kCount, 3});
  recorder.submitAndWait();
  const auto results = out.download<Result>(2 * kCount);
  int wrong[2] = {};
  for (std::uint32_t i = 0; i < kCount; ++i) {
    wrong[0] += results[2 * i] != steps(items_[i]);
    wrong[1] += results[2 * i + 1] != queue(i);
  }
  EXPECT_EQ(wrong[0], 0) << "one loop";
  EXPECT_EQ(wrong[1], 0) << "a loop in a loop that takes numbers";
}

}  // namespace
}  // namespace importon
