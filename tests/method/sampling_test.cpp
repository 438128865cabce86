// lib/sampling.glsl: each warp has the density that it states. Significance of each test: 1e-4.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::sampling_test {
namespace {

/// As in tests/kernels/warps.comp.
struct Sample {
  uint warp;
  float cosMax;
  vec2 u;
  vec3 axis;
};
struct Warped {
  vec3 point;
  vec3 frame[3];
};

enum Warp : uint { kDisc, kCosine, kSphere, kCone, kTriangle, kHeuristic };
constexpr std::size_t kSamples = 200'000;

class Warps : public test::GpuTest {
 protected:
  std::vector<Warped> warped(Warp warp, float cosMax = 0) const {
    std::mt19937 random(warp + 1);
    std::uniform_real_distribution<float> unit;
    std::normal_distribution<float> normal;
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < kSamples; ++i)
      samples.push_back({warp,
                         cosMax,
                         {std::min(unit(random), 0.99999994f), std::min(unit(random), 0.99999994f)},
                         glm::normalize(vec3(normal(random), normal(random), normal(random)))});
    return test::runKernel<Warped>(context(), test_kernels::code("warps"), samples);
  }

  /// That the points, taken back to the unit square by `unwarp`, are uniform there.
  template <class Unwarp>
  static void expectUniform(const std::vector<Warped>& points, Unwarp unwarp) {
    constexpr int kSide = 20;
    std::vector<double> observed(kSide * kSide),
        expected(kSide * kSide, static_cast<double>(points.size()) / (kSide * kSide));
    for (const Warped& w : points) {
      const glm::dvec2 u = unwarp(glm::dvec3(w.point));
      const auto cell = [](double v) { return std::clamp(static_cast<int>(v * kSide), 0, kSide - 1); };
      ASSERT_TRUE(u.x > -1e-5 && u.x < 1 + 1e-5 && u.y > -1e-5 && u.y < 1 + 1e-5) << u.x << ' ' << u.y;
      ++observed[static_cast<std::size_t>(cell(u.x) * kSide + cell(u.y))];
    }
    EXPECT_GT(test::chiSquareTest(observed, expected).pValue, 1e-4);
  }

  static double azimuth(const glm::dvec3& p) { return std::atan2(p.y, p.x) / (2 * M_PI) + 0.5; }
  static void expectUnit(const std::vector<Warped>& points) {
    for (const Warped& w : points) ASSERT_NEAR(glm::length(w.point), 1, 1e-6);
  }
};

/// [Veach 1997, eq. 9.15], with beta 2.
TEST_F(Warps, HeuristicIsTheShareOfTheSquaredDensity) {
  std::vector<Sample> densities;
  for (const vec2& u : {vec2(1, 1), vec2(3, 1), vec2(1, 3), vec2(1e30f, 1), vec2(1, 1e30f), vec2(2, 0)})
    densities.push_back({kHeuristic, 0, u, vec3(0, 0, 1)});
  const float expected[] = {0.5f, 0.9f, 0.1f, 1, 0, 1};
  const auto weights = test::runKernel<Warped>(context(), test_kernels::code("warps"), densities);
  for (std::size_t i = 0; i < densities.size(); ++i) EXPECT_NEAR(weights[i].point.x, expected[i], 1e-6f) << i;
}

TEST_F(Warps, DiscIsUniform) {
  expectUniform(warped(kDisc), [](const glm::dvec3& p) { return glm::dvec2(p.x * p.x + p.y * p.y, azimuth(p)); });
}

TEST_F(Warps, CosineHemisphereHasTheDensityOfTheCosine) {
  const auto points = warped(kCosine);
  expectUnit(points);
  for (const Warped& w : points) ASSERT_GE(w.point.z, 0.0f);
  expectUniform(points, [](const glm::dvec3& p) { return glm::dvec2(p.z * p.z, azimuth(p)); });
}

TEST_F(Warps, SphereIsUniform) {
  const auto points = warped(kSphere);
  expectUnit(points);
  expectUniform(points, [](const glm::dvec3& p) { return glm::dvec2(0.5 + 0.5 * p.z, azimuth(p)); });
}

TEST_F(Warps, ConeIsUniform) {
  for (const float cosMax : {-0.5f, 0.0f, 0.9f}) {
    const auto points = warped(kCone, cosMax);
    expectUnit(points);
    expectUniform(points, [&](const glm::dvec3& p) {
      return glm::dvec2((1 - p.z) / (1 - static_cast<double>(cosMax)), azimuth(p));
    });
  }
}

TEST_F(Warps, TriangleIsUniform) {
  expectUniform(warped(kTriangle), [](const glm::dvec3& p) {
    const double sum = p.x + p.y;
    return glm::dvec2(sum * sum, sum > 0 ? p.x / sum : 0.0);
  });
}

TEST_F(Warps, FramesAreRightHandedAndOrthonormal) {
  std::vector<Sample> samples;
  for (const vec3& axis :
       {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0), vec3(0, -1, 0), glm::normalize(vec3(1e-4f, 0, -1))})
    samples.push_back({kDisc, 0, vec2(0.5f), axis});
  auto frames = test::runKernel<Warped>(context(), test_kernels::code("warps"), samples);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].frame[2], samples[i].axis);
  for (const Warped& w : warped(kDisc)) frames.push_back(w);
  for (const Warped& w : frames) {
    ASSERT_NEAR(glm::length(w.frame[0]), 1, 1e-6);
    ASSERT_NEAR(glm::length(w.frame[1]), 1, 1e-6);
    ASSERT_NEAR(glm::length(glm::cross(w.frame[0], w.frame[1]) - w.frame[2]), 0, 1e-6);
  }
}

}  // namespace
}  // namespace importon::sampling_test
