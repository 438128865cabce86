// lib/map_point.glsl and lib/octahedral.glsl: what packing loses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

/// As in tests/kernels/map_point.comp.
struct Plain {
  vec3 direction, normal;
  uint level;
};
struct Unpacked {
  vec3 direction, normal;
  uint level, levelAfterChange;
  vec3 directionAfterChange;
  uint isLikeSelf, isLikeOpposite;
};

/// Largest angle, in radians, between a vector and what an octahedral map of bitsX and bitsY gives back: half a
/// step along both axes in the middle of a face, where the map stretches most.
double largestAngle(int bitsX, int bitsY) {
  const double x = 1.0 / ((1 << bitsX) - 1), y = 1.0 / ((1 << bitsY) - 1);
  return std::sqrt(3 * (x * x + y * y + (x + y) * (x + y)));
}

double angleBetween(const vec3& a, const vec3& b) {
  return std::atan2(glm::length(glm::cross(glm::dvec3(a), glm::dvec3(b))), glm::dot(glm::dvec3(a), glm::dvec3(b)));
}

/// Random ones, and those where octahedra have their corners and edges.
std::vector<Plain> directions() {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<vec3> unit;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) unit.push_back(glm::normalize(vec3(x, y, z)));
  while (unit.size() < 100'000) unit.push_back(glm::normalize(vec3(normal(random), normal(random), normal(random))));
  std::vector<Plain> all;
  for (std::size_t i = 0; i < unit.size(); ++i)
    all.push_back({unit[i], unit[unit.size() - 1 - i], static_cast<uint>(i % 21)});
  return all;
}

class MapPointPacking : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    plain_ = directions();
    unpacked_ = test::runKernel<Unpacked>(context(), test_kernels::code("map_point"), plain_);
  }
  std::vector<Plain> plain_;
  std::vector<Unpacked> unpacked_;
};

TEST_F(MapPointPacking, DirectionsAreWithinAStepOfSixteenBits) {
  double largest = 0;
  for (std::size_t i = 0; i < plain_.size(); ++i) {
    largest = std::max(largest, angleBetween(plain_[i].direction, unpacked_[i].direction));
    ASSERT_NEAR(glm::length(unpacked_[i].direction), 1, 1e-6);
  }
  EXPECT_LE(largest, largestAngle(8, 8) * 1.001);
  EXPECT_GE(largest, largestAngle(8, 8) * 0.8) << "packed in more bits than the format has";
}

TEST_F(MapPointPacking, NormalsAreWithinAStepOfElevenBits) {
  double largest = 0;
  for (std::size_t i = 0; i < plain_.size(); ++i)
    largest = std::max(largest, angleBetween(plain_[i].normal, unpacked_[i].normal));
  EXPECT_LE(largest, largestAngle(6, 5) * 1.001);
  EXPECT_GE(largest, largestAngle(6, 5) * 0.8) << "packed in more bits than the format has";
}

TEST_F(MapPointPacking, APackedNormalIsLikeTheTrueOneAndNotLikeThatOfTheOtherSide) {
  for (std::size_t i = 0; i < plain_.size(); ++i) {
    ASSERT_EQ(unpacked_[i].isLikeSelf, 1u) << i;
    ASSERT_EQ(unpacked_[i].isLikeOpposite, 0u) << i;
  }
}

TEST_F(MapPointPacking, LevelsComeBackAndChangeWithoutTheRest) {
  for (std::size_t i = 0; i < plain_.size(); ++i) {
    ASSERT_EQ(unpacked_[i].level, plain_[i].level);
    ASSERT_EQ(unpacked_[i].levelAfterChange, 20 - plain_[i].level);
    ASSERT_EQ(unpacked_[i].directionAfterChange, unpacked_[i].direction);
  }
}

}  // namespace
}  // namespace importon
