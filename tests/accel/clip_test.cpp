#include "accel/clip.h"

#include <gtest/gtest.h>

namespace importon::test {
namespace {

const Box kEverywhere{Float4{-100, -100, -100, 0}, Float4{100, 100, 100, 0}};

void expectBox(const Box& box, vec3 low, vec3 high) {
  EXPECT_EQ(toVec3(box.lo), low);
  EXPECT_EQ(toVec3(box.hi), high);
}

}  // namespace

TEST(ClippedTriangle, IsCutIntoTwoPartsThatShareThePlane) {
  const ClippedTriangle triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  const auto [below, above] = triangle.cut(0, 1.0f);
  expectBox(below.box(kEverywhere), {0, 0, 1}, {1, 4, 1});
  expectBox(above.box(kEverywhere), {1, 0, 1}, {4, 3, 1});
  EXPECT_FLOAT_EQ(triangle.projectedArea(), 8.0f);
  EXPECT_FLOAT_EQ(below.projectedArea(), 3.5f);
  EXPECT_FLOAT_EQ(above.projectedArea(), 4.5f);
}

TEST(ClippedTriangle, IsWhollyOnOneSideOfAPlaneThatItDoesNotReach) {
  const ClippedTriangle triangle({0, 0, 1}, {4, 0, 1}, {0, 4, 1});
  const auto [below, above] = triangle.cut(1, 5.0f);
  EXPECT_TRUE(above.isEmpty());
  expectBox(below.box(kEverywhere), {0, 0, 1}, {4, 4, 1});
}

TEST(ClippedTriangle, ProjectedAreaCountsAllThreeAxes) {
  EXPECT_FLOAT_EQ(ClippedTriangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}).projectedArea(), 1.5f);
}

TEST(ClippedTriangle, BoxHoldsTheCutsExactlyAndStaysWithin) {
  const ClippedTriangle triangle({0, 0, 0}, {1, 3, 0}, {1, 3, 0.7f});
  const auto [below, above] = triangle.cut(0, 0.3f);
  const Box box = below.box(kEverywhere);
  const double crossing = 3 * static_cast<double>(0.3f);
  EXPECT_GE(static_cast<double>(box.hi[1]), crossing);
  EXPECT_LT(static_cast<double>(box.hi[1]), crossing + 1e-6);
  EXPECT_EQ(box.hi[0], 0.3f);
  const Box narrow{Float4{0, 0.5f, 0, 0}, Float4{1, 0.6f, 1, 0}};
  EXPECT_EQ(above.box(narrow).hi[1], 0.6f);
}

TEST(ClippedTriangle, BearsSixCuts) {
  ClippedTriangle part({-1, -1, -1.5f}, {2, -0.5f, 1}, {-0.5f, 2, 1});
  for (int axis = 0; axis < 3; ++axis) part = part.cut(axis, -0.2f).second.cut(axis, 0.9f).first;
  ASSERT_FALSE(part.isEmpty());
  const Box box = part.box(kEverywhere);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(box.lo[axis], -0.2f);
    EXPECT_LE(box.hi[axis], 0.9f);
  }
}

}  // namespace importon::test
