// Rays that leave a surface (lib/offset.glsl) don't meet it again (lib/triangle_intersection.glsl).
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "accel/encode.h"
#include "accel_test_kernels/registry.h"
#include "support/gpu_test.h"

namespace importon::test {
namespace {

struct Leaving {
  vec3 v0, v1, v2;
  float u, v;
  vec3 direction;
  std::uint32_t turn;
};
struct Outcome {
  std::uint32_t hitsAgain;
  vec3 origin;
};

using OffsetTest = GpuTest;

/// A triangle of any shape with edges about 10^size m at about 10^distance m from the origin, and a ray off a
/// point of it. Sizes stay above what float positions resolve there.
Leaving randomLeaving(std::mt19937& engine) {
  const auto unit = [&] { return static_cast<double>(engine() >> 8) * 0x1p-24; };
  const auto cube = [&] {
    const double x = unit(), y = unit(), z = unit();
    return 2.0 * glm::dvec3(x, y, z) - 1.0;
  };
  for (;;) {
    const double distance = std::pow(10.0, 12 * unit() - 6);
    const double size = std::max(std::pow(10.0, 12 * unit() - 6), 1e-4 * distance);
    const glm::dvec3 centre = glm::normalize(cube()) * distance;
    Leaving l{};
    l.v0 = vec3(centre + size * cube());
    l.v1 = vec3(centre + size * cube());
    l.v2 = vec3(centre + size * cube());
    if (glm::length(glm::cross(l.v1 - l.v0, l.v2 - l.v0)) == 0.0f) continue;
    const double r = std::sqrt(unit()), s = unit();
    l.u = static_cast<float>(r * (1 - s));
    l.v = static_cast<float>(r * s);
    l.direction = vec3(glm::normalize(cube()));
    l.turn = asTriangle(makeBvhTriangle({l.v0, l.v1, l.v2}, 0, 0)).kind & kBvhTurnMask;
    return l;
  }
}

}  // namespace

TEST_F(OffsetTest, ARayThatLeavesATriangleNeverHitsItAgain) {
  std::mt19937 engine(5);
  std::vector<Leaving> leaving;
  for (int i = 0; i < 1000000; ++i) leaving.push_back(randomLeaving(engine));
  const auto outcomes = runKernel<Outcome>(context(), accel_test_kernels::code("leaving_ray"), leaving);
  std::size_t again = 0;
  for (const Outcome& outcome : outcomes) again += outcome.hitsAgain;
  EXPECT_EQ(again, 0u);
}

TEST_F(OffsetTest, OriginsLieOnTheSideThatTheRayGoesTo) {
  std::mt19937 engine(6);
  std::vector<Leaving> leaving;
  for (int i = 0; i < 200000; ++i) leaving.push_back(randomLeaving(engine));
  const auto outcomes = runKernel<Outcome>(context(), accel_test_kernels::code("leaving_ray"), leaving);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < leaving.size(); ++i) {
    const Leaving& l = leaving[i];
    const glm::dvec3 v0(l.v0), a = glm::dvec3(l.v1) - v0, b = glm::dvec3(l.v2) - v0;
    const glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    // Slivers have no plane to speak of in floats: the normal that the kernel makes of them is arbitrary.
    if (glm::length(glm::cross(a, b)) < 1e-3 * glm::dot(a, a) || glm::length(glm::cross(a, b)) < 1e-3 * glm::dot(b, b))
      continue;
    const double side = glm::dot(glm::dvec3(outcomes[i].origin) - v0, normal);
    const double towards = glm::dot(glm::dvec3(l.direction), normal);
    if (std::abs(towards) > 1e-3 && side * towards <= 0) ++wrong;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST_F(OffsetTest, OffsetsAreAFewRoundingsOfPositionAndSize) {
  const std::vector<Leaving> leaving{{vec3(0, 0, 8), vec3(1, 0, 8), vec3(0, 1, 8), 0.25f, 0.25f, vec3(0, 0, 1), 0},
                                     {vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 0.25f, 0.25f, vec3(0, 0, -1), 0}};
  const auto outcomes = runKernel<Outcome>(context(), accel_test_kernels::code("leaving_ray"), leaving);
  EXPECT_GT(outcomes[0].origin.z, 8.0f);
  EXPECT_LT(outcomes[0].origin.z, 8.0f + 8.0f * 0x1p-21f);
  EXPECT_LE(outcomes[1].origin.z, 0.0f);
  EXPECT_GT(outcomes[1].origin.z, -0x1p-20f);
}

}  // namespace importon::test
