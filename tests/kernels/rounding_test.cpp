// Quotients and roots for drivers that round them as they like: the nearest float, though estimates are off by more
// than Vulkan allows.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

/// As in rounding.comp.
struct Estimated {
  float a, b;
  std::int32_t off;
};
struct Rounded {
  float quotient, root;
};

class Rounding : public test::GpuTest {
 protected:
  /// Normal floats whose exponents are within `exponents` / 2 of 0; some are neighbours of each other, whose quotients
  /// are next to 1.
  static std::vector<Estimated> queries(std::uint32_t count, std::uint32_t exponents) {
    std::vector<Estimated> result(count);
    std::uint64_t state = 1;
    const auto random = [&state] {  // [Knuth, MMIX]
      state = state * 6364136223846793005u + 1442695040888963407u;
      return static_cast<std::uint32_t>(state >> 33);
    };
    const auto normal = [&] {
      const std::uint32_t exponent = 127 - exponents / 2 + random() % exponents;
      return (random() & 1) << 31 | exponent << 23 | (random() & 0x7FFFFFu);
    };
    for (Estimated& q : result) {
      const std::uint32_t a = normal(), b = random() % 8 == 0 ? a ^ (random() & 7u) : normal();
      q = {std::bit_cast<float>(a), std::bit_cast<float>(b), static_cast<std::int32_t>(random() % 13) - 6};
    }
    return result;
  }

  void expectNearest(const std::vector<Estimated>& items) {
    const auto results = test::runKernel<Rounded>(context(), test_kernels::code("rounding"), items);
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Estimated& q = items[i];
      const float quotient = q.a / q.b;
      if (std::abs(quotient) >= std::numeric_limits<float>::min())
        ASSERT_EQ(results[i].quotient, quotient) << q.a << " / " << q.b << ", off by " << q.off;
      else
        ASSERT_EQ(results[i].quotient, 0) << q.a << " / " << q.b;
      ASSERT_EQ(results[i].root, std::sqrt(std::abs(q.a))) << q.a << ", off by " << q.off;
    }
  }
};

TEST_F(Rounding, QuotientsAndRootsAreTheNearestFloats) {
  expectNearest(queries(1u << 18, 2));
  expectNearest(queries(1u << 18, 253));
}

TEST_F(Rounding, SlowOfSixteenMillionQueries) { expectNearest(queries(1u << 24, 40)); }

}  // namespace
}  // namespace importon
