// lib/flux.glsl against 64-bit arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

/// As in tests/kernels/flux.comp.
struct Operands {
  uvec2 a, b;
  uint divisor;
  float units;
  vec3 flux;
};
struct Results {
  uvec2 sum, quotient;
  uint rest;
  uvec2 fromFloat;
  float toFloat;
  vec3 unpacked;
};

std::uint64_t whole(uvec2 words) { return std::uint64_t{words.y} << 32 | words.x; }
uvec2 words(std::uint64_t value) { return {static_cast<uint>(value), static_cast<uint>(value >> 32)}; }

/// Random numbers of all magnitudes below 2^62.
std::vector<Operands> randomOperands(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> exponent(-100, 100), mantissa(1, 2);
  const auto number = [&] { return random() >> (2 + random() % 62); };
  const auto flux = [&] { return std::ldexp(mantissa(random), static_cast<int>(exponent(random))); };
  std::vector<Operands> all;
  for (std::size_t i = 0; i < count; ++i) {
    const uint divisor = 1 + static_cast<uint>(i % 3 == 0 ? random() % 65535 : random() % 32);
    all.push_back({words(number()), words(number()), divisor, static_cast<float>(number()), {flux(), flux(), flux()}});
  }
  for (const std::uint64_t edge : {0ull, 1ull, 0xFFFFFFFFull, 0x100000000ull, 0x3FFFFFFFFFFFFFFFull})
    all.push_back({words(edge), words(edge), 7, static_cast<float>(edge >> 1), vec3(0, 1, 2)});
  return all;
}

class Flux : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    operands_ = randomOperands(100'000);
    results_ = test::runKernel<Results>(context(), test_kernels::code("flux"), operands_);
  }
  std::vector<Operands> operands_;
  std::vector<Results> results_;
};

TEST_F(Flux, SumsAreExact) {
  for (std::size_t i = 0; i < operands_.size(); ++i)
    ASSERT_EQ(whole(results_[i].sum), whole(operands_[i].a) + whole(operands_[i].b));
}

TEST_F(Flux, QuotientsAndRestsAreExact) {
  for (std::size_t i = 0; i < operands_.size(); ++i) {
    ASSERT_EQ(whole(results_[i].quotient), whole(operands_[i].a) / operands_[i].divisor);
    ASSERT_EQ(results_[i].rest, whole(operands_[i].a) % operands_[i].divisor);
  }
}

TEST_F(Flux, FloatsBecomeTheWholeNumbersThatTheyAre) {
  for (std::size_t i = 0; i < operands_.size(); ++i)
    ASSERT_EQ(whole(results_[i].fromFloat), static_cast<std::uint64_t>(operands_[i].units));
}

TEST_F(Flux, WholeNumbersBecomeTheNearestFloatsButOne) {
  for (std::size_t i = 0; i < operands_.size(); ++i) {
    const double exact = static_cast<double>(whole(operands_[i].a));
    ASSERT_NEAR(static_cast<double>(results_[i].toFloat), exact, 0x1p-22 * exact);
  }
}

TEST_F(Flux, PackingLosesNoMoreThanHalfAStepOfThirteenBits) {
  double largest = 0;
  for (std::size_t i = 0; i < operands_.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double exact = operands_[i].flux[c], unpacked = results_[i].unpacked[c];
      if (exact == 0) {
        ASSERT_EQ(unpacked, 0);
        continue;
      }
      largest = std::max(largest, std::abs(unpacked / exact - 1));
    }
  }
  EXPECT_LE(largest, 0x1p-14);
  EXPECT_GE(largest, 0x1p-15) << "packed in more bits than the format has";
}

TEST_F(Flux, PackingScalesExactlyByPowersOfTwo) {
  std::vector<Operands> scaled = operands_;
  for (Operands& o : scaled) o.flux *= 0x1p17f;
  const auto results = test::runKernel<Results>(context(), test_kernels::code("flux"), scaled);
  for (std::size_t i = 0; i < operands_.size(); ++i) ASSERT_EQ(results[i].unpacked, results_[i].unpacked * 0x1p17f);
}

}  // namespace
}  // namespace importon
