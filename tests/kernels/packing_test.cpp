// lib/packing.glsl unpacks what scene/packing.h packs, as its twin does on the host.
#include "scene/packing.h"

#include <gtest/gtest.h>

#include <random>

#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

constexpr std::size_t kFloats = 11;
constexpr double kUlps = 1e-6;  // a few roundings of a float near 1

class Packing : public test::GpuTest {};

TEST_F(Packing, TheDeviceUnpacksLikeTheHost) {
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  std::vector<uint> items;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
    items.push_back(packNormal(direction));
    items.push_back(packTangent(direction, i % 3 == 0));
  }
  const std::vector<float> results = test::runKernel<uint, float>(context(), test_kernels::code("packing"),
                                                                  std::span<const uint>(items), items.size() * kFloats);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const float* result = &results[i * kFloats];
    const vec3 normal = unpackNormal(items[i]);
    const vec4 tangent = unpackTangent(items[i]);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(result[c], normal[c], kUlps) << i;
    for (int c = 0; c < 4; ++c) ASSERT_NEAR(result[3 + c], tangent[c], kUlps) << i;
  }
}

TEST_F(Packing, ColoursOnTheDeviceAreThoseOfTheHost) {
  const vec4 color(0.25f, 1.0f, 1000.0f, 0.5f);  // half floats hold these
  const uvec2 packed = packColor(color);
  const std::vector<uint> items = {packed.x, packed.y};
  const std::vector<float> results =
      test::runKernel<uint, float>(context(), test_kernels::code("packing"), std::span<const uint>(items), kFloats);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(results[static_cast<std::size_t>(7 + c)], color[c]);
}

}  // namespace
}  // namespace importon
