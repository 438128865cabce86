// lib/light_tree.glsl: lights are chosen with the probability that is stated, and near ones more often.
#include "render/device_scene/light_tree.h"

#include <gtest/gtest.h>

#include <random>

#include "support/gpu_test.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::light_tree_test {
namespace {

/// As in tests/kernels/light_tree.comp.
struct Query {
  vec3 x{0.0f};
  float u = 0;
  uint light = 0;
  uvec2 seen{~0u};
};
struct Answer {
  uint chosen;
  float chosenProbability, probability;
};
struct Push {
  std::uint32_t count, lights;
};

/// Small patches of all orientations and very different powers in a cube of side 10, some light from far away.
std::vector<LightBounds> someLights(std::size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-5, 5), exponent(-3, 3);
  std::normal_distribution<float> normal;
  std::vector<LightBounds> lights(count);
  for (LightBounds& light : lights) {
    light.low = vec3(place(random), place(random), place(random));
    light.high = light.low + 0.1f;
    light.axis = glm::normalize(vec3(normal(random), normal(random), normal(random)));
    light.cosCone = 1;
    light.power = std::exp(exponent(random));
  }
  for (const std::size_t i : {std::size_t{3}, count / 2}) {
    lights[i].isInfinite = true;
    lights[i].power = 0.2f;
  }
  return lights;
}

class LightTree : public test::GpuTest {
 protected:
  std::vector<Answer> ask(const std::vector<LightBounds>& lights, const std::vector<Query>& queries) const {
    const gpu::Kernel kernel(context(), "light tree", test_kernels::code("light_tree"), {});
    const std::vector<uvec4> texels = buildLightTree(lights);
    const gpu::Buffer input = gpu::makeBuffer(context(), "queries", std::span<const Query>(queries));
    const gpu::Buffer output(context(), "answers", queries.size() * sizeof(Answer));
    const gpu::Buffer tree =
        gpu::makeBuffer(context(), "tree", std::span<const uvec4>(texels), gpu::TexelFormat::uint4);
    const gpu::Buffer* const bindings[] = {&input, &output, &tree};
    gpu::Recorder recorder(context());
    recorder.dispatch(kernel, bindings, queries.size(),
                      Push{static_cast<std::uint32_t>(queries.size()), static_cast<std::uint32_t>(lights.size())});
    recorder.submitAndWait();
    return output.download<Answer>(queries.size());
  }
};

const std::vector<vec3> kPlaces{vec3(0), vec3(4.9f, -4.9f, 1), vec3(30, 0, 0), vec3(-5)};

TEST_F(LightTree, ProbabilitiesOfAllLightsSumToOne) {
  for (const std::size_t count : {1u, 2u, 5u, 500u}) {
    const auto lights = count < 4 ? std::vector(count, LightBounds{.power = 1}) : someLights(count);
    for (const vec3& x : kPlaces) {
      std::vector<Query> queries;
      for (uint i = 0; i < count; ++i) queries.push_back({x, 0, i, uvec2(0x00F0A001u, 0x80000010u)});
      double sum = 0;
      for (const Answer& a : ask(lights, queries)) {
        EXPECT_GT(a.probability, 0);
        sum += static_cast<double>(a.probability);
      }
      EXPECT_NEAR(sum, 1, 1e-5);
    }
  }
}

// Significance: 1e-4 for each of four tests.
TEST_F(LightTree, LightsAreChosenWithTheStatedProbability) {
  constexpr std::size_t kSamples = 100'000, kLights = 100;
  const auto lights = someLights(kLights);
  for (const vec3& x : kPlaces) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0, 0.99999994f);
    std::vector<Query> queries(kSamples, Query{.x = x, .seen = uvec2(0xF000FF01u, 0x0000A0A0u)});
    for (std::size_t i = 0; i < kSamples; ++i) queries[i].u = unit(random);
    for (uint i = 0; i < kLights; ++i) queries[i].light = i;
    const auto answers = ask(lights, queries);
    std::vector<double> counts(kLights), expected(kLights);
    double sum = 0;
    for (std::size_t i = 0; i < kLights; ++i)
      sum += expected[i] = static_cast<double>(answers[i].probability) * kSamples;
    for (double& e : expected) e *= kSamples / sum;
    for (const Answer& a : answers) {
      ++counts[a.chosen];
      ASSERT_NEAR(a.chosenProbability / answers[a.chosen].probability, 1, 1e-5);
    }
    EXPECT_GT(test::chiSquareTest(counts, expected).pValue, 1e-4);
  }
}

TEST_F(LightTree, NearLightsThatFaceThePointAreLikelier) {
  std::vector<LightBounds> lights(
      3, LightBounds{
             .low = vec3(-1, 0, 0), .high = vec3(-0.9f, 0.1f, 0.1f), .axis = vec3(1, 0, 0), .cosCone = 1, .power = 1});
  lights[1].axis = -lights[1].axis;  // turned away
  lights[2].low -= vec3(5, 0, 0);    // far away
  lights[2].high -= vec3(5, 0, 0);
  const auto answers = ask(lights, {{vec3(1, 0, 0), 0, 0}, {vec3(1, 0, 0), 0, 1}, {vec3(1, 0, 0), 0, 2}});
  EXPECT_GT(answers[0].probability, 5 * answers[1].probability);
  EXPECT_GT(answers[0].probability, 5 * answers[2].probability);
}

// Of equal lights in a row, the tree's first step parts the left half from the right one.
TEST_F(LightTree, LightsOfGroupsThatAreNotSeenAreChosenSeldom) {
  constexpr std::size_t kLights = 256;
  std::vector<LightBounds> lights(kLights, LightBounds{.power = 1});
  for (std::size_t i = 0; i < kLights; ++i) lights[i].low = lights[i].high = vec3(static_cast<float>(i), 0, 0);
  const vec3 x(127.5f, 0, 1e4f);  // from there all are worth the same
  const uvec2 leftHalf(0x55555555u), oneGroup(0x1u, 0u);
  std::vector<Query> queries;
  for (uint i = 0; i < kLights; ++i) queries.push_back({x, 0, i, leftHalf});
  for (uint i = 0; i < kLights; ++i) queries.push_back({x, 0, i, oneGroup});
  const auto answers = ask(lights, queries);
  double left = 0, group = 0;
  for (std::size_t i = 0; i < kLights / 2; ++i) left += static_cast<double>(answers[i].probability);
  for (std::size_t i = 0; i < kLights / 64; ++i) group += static_cast<double>(answers[kLights + i].probability);
  EXPECT_NEAR(left, 1 / 1.05, 1e-3);
  EXPECT_GT(group, 0.2);  // of a 64th of the lights
  EXPECT_LT(answers[kLights + 4].probability, answers[kLights].probability / 10);
}

}  // namespace
}  // namespace importon::light_tree_test
