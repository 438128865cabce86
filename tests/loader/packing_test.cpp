#include "scene/packing.h"

#include <gtest/gtest.h>

#include <random>

namespace importon {
namespace {

glm::dvec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

double angleBetween(const glm::dvec3& a, const vec3& b) { return glm::length(a - glm::dvec3(b)); }

TEST(Packing, NormalsComeBackWithinTheResolutionOfSixteenBits) {
  std::mt19937 random(1);
  for (int i = 0; i < 100000; ++i) {
    const glm::dvec3 direction = randomDirection(random);
    const uint packed = packNormal(direction);
    ASSERT_NE(packed, kNone);
    ASSERT_LT(angleBetween(direction, unpackNormal(packed)), 7.5e-5);
  }
}

TEST(Packing, AxesAreExact) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 direction(0.0);
      direction[axis] = sign;
      EXPECT_EQ(unpackNormal(packNormal(direction)), vec3(direction));
      EXPECT_EQ(vec3(unpackTangent(packTangent(direction, false))), vec3(direction));
    }
  }
}

TEST(Packing, TangentsKeepTheSignOfTheBitangent) {
  std::mt19937 random(2);
  for (int i = 0; i < 100000; ++i) {
    const glm::dvec3 direction = randomDirection(random);
    for (const bool isNegative : {false, true}) {
      const uint packed = packTangent(direction, isNegative);
      ASSERT_NE(packed, kNone);
      const vec4 tangent = unpackTangent(packed);
      ASSERT_LT(angleBetween(direction, vec3(tangent)), 1.5e-4);
      ASSERT_EQ(tangent.w, isNegative ? -1.0f : 1.0f);
    }
  }
}

TEST(Packing, TheDirectionWhoseBitsMeanNoneIsMovedAside) {
  const vec3 normal = directionFromOctahedron(vec2(-1.0f / 32767.0f));
  EXPECT_NE(packNormal(glm::dvec3(normal)), kNone);
  EXPECT_LT(angleBetween(glm::dvec3(normal), unpackNormal(packNormal(glm::dvec3(normal)))), 7.5e-5);
  const vec3 tangent = directionFromOctahedron(vec2(-1.0f / 32767.0f, -1.0f / 16383.0f));
  EXPECT_NE(packTangent(glm::dvec3(tangent), true), kNone);
  EXPECT_LT(angleBetween(glm::dvec3(tangent), vec3(unpackTangent(packTangent(glm::dvec3(tangent), true)))), 1.5e-4);
}

TEST(Packing, ColoursAreHalfFloats) {
  const uvec2 packed = packColor(vec4(0.5f, 1.0f, 1e9f, 0.0f));
  EXPECT_EQ(glm::unpackHalf2x16(packed.x), vec2(0.5f, 1.0f));
  EXPECT_EQ(glm::unpackHalf2x16(packed.y), vec2(65504.0f, 0.0f));
}

}  // namespace
}  // namespace importon
