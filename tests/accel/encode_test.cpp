#include "accel/encode.h"

#include <gtest/gtest.h>

#include <cmath>

namespace importon::test {
namespace {

Box box(float x0, float y0, float z0, float x1, float y1, float z1) {
  return {Float4{x0, y0, z0, 0.0f}, Float4{x1, y1, z1, 0.0f}};
}

}  // namespace

TEST(MakeBvhTriangle, PutsTheVertexOppositeTheLongestEdgeFirstAndKeepsTheOrder) {
  const std::array<vec3, 3> corners{vec3(0, 0, 0), vec3(5, 0, 0), vec3(4, 1, 0)};  // longest: 0 to 1
  for (std::uint32_t first = 0; first < 3; ++first) {
    const std::array<vec3, 3> turned{corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]};
    const BvhTriangle record = asTriangle(makeBvhTriangle(turned, 17, 99));
    EXPECT_EQ(record.v0, corners[2]);
    EXPECT_EQ(record.v1, corners[0]);
    EXPECT_EQ(record.v2, corners[1]);
    EXPECT_EQ(turned[record.kind & kBvhTurnMask], corners[2]);
    EXPECT_EQ(record.kind & ~kBvhTurnMask, kBvhLeaf);
    EXPECT_EQ(record.triangle, 17u);
    EXPECT_EQ(record.next, 99u);
  }
}

TEST(MakeBvhNode, BoxesStandOffTheChildrenByAMarginButNotByMuch) {
  const std::vector<Box> children{box(0, 0, 0, 1, 1, 1), box(0.3f, 0.1f, 0.7f, 0.9f, 0.2f, 0.70001f),
                                  box(-5, 0, 0.5f, -4.99f, 1, 0.5f)};
  const BvhNode node = asNode(makeBvhNode(children, 42));
  EXPECT_EQ(node.firstChild, 42u);
  for (std::uint32_t slot = 0; slot < 3; ++slot) {
    ASSERT_TRUE(hasChild(node, slot));
    const Box seen = childBox(node, slot);
    for (int axis = 0; axis < 3; ++axis) {
      const int exponent = static_cast<int>((node.gridExponents >> (8 * axis)) & 255u) - 127;
      const float step = std::ldexp(1.0f, exponent);
      EXPECT_LE(seen.lo[axis], children[slot].lo[axis] - step / 2048);
      EXPECT_GE(seen.hi[axis], children[slot].hi[axis] + step / 2048);
      EXPECT_GE(seen.lo[axis], children[slot].lo[axis] - 1.01f * step);
      EXPECT_LE(seen.hi[axis], children[slot].hi[axis] + 1.01f * step);
    }
  }
  EXPECT_FALSE(hasChild(node, 3));
}

TEST(MakeBvhNode, GridIsAtMostTwiceAsCoarseAsNeedBe) {
  for (const float extent : {1e-20f, 0.001f, 0.99f, 1.0f, 253.0f, 254.0f, 255.0f, 256.0f, 1e20f}) {
    const std::vector<Box> children{box(0, 0, 0, extent, extent, extent)};
    const BvhNode node = asNode(makeBvhNode(children, 1));
    const int exponent = static_cast<int>(node.gridExponents & 255u) - 127;
    EXPECT_LE(std::ldexp(253.0f, exponent - 1), extent) << extent;
  }
}

TEST(MakeBvhNode, HoldsFlatBoxesFarFromTheOrigin) {
  const std::vector<Box> children{box(1e7f, -3, 0, 1e7f, -3, 0)};
  const BvhNode node = asNode(makeBvhNode(children, 1));
  const Box seen = childBox(node, 0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(seen.lo[axis], children[0].lo[axis]);
    EXPECT_GE(seen.hi[axis], children[0].hi[axis]);
    EXPECT_LE(seen.hi[axis] - seen.lo[axis], 4.0f);
  }
}

}  // namespace importon::test
