// lib/environment.glsl: directions are drawn with the stated density, and the map stands as documented.
// Significance of each test: 1e-4.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "accel/bvh.h"
#include "method/sphere_histogram.h"
#include "render/device_scene/device_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::environment_test {
namespace {

/// As in tests/kernels/environment.comp.
struct Query {
  vec2 u{0.5f};
  vec3 direction{0, 1, 0};
};
struct Answer {
  vec3 sampled;
  float sampledPdf;
  vec3 radiance;
  float pdf;
};
struct Push {
  std::uint32_t count;
  uvec2 size;
};

class Environments : public test::GpuTest {
 protected:
  std::vector<Answer> ask(const EnvironmentMap& map, const std::vector<Query>& queries) const {
    test::SceneBuilder builder;
    builder.square(builder.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 1);
    builder.environment(map);
    const Scene scene = builder.finish();
    const DeviceScene device = uploadScene(context(), scene, buildBvh(scene.positions, scene.triangles));
    const gpu::Kernel kernel(context(), "environment", test_kernels::code("environment"), {});
    const gpu::Buffer input = gpu::makeBuffer(context(), "queries", std::span<const Query>(queries));
    const gpu::Buffer output(context(), "answers", queries.size() * sizeof(Answer));
    const gpu::Buffer* const bindings[] = {&input, &output, &device.environment, &device.environmentDraw};
    gpu::Recorder recorder(context());
    recorder.dispatch(kernel, bindings, queries.size(),
                      Push{static_cast<std::uint32_t>(queries.size()), uvec2(map.width, map.height)});
    recorder.submitAndWait();
    return output.download<Answer>(queries.size());
  }
};

EnvironmentMap randomMap(int width, int height) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0, 2);
  EnvironmentMap map{width, height, {}};
  for (int i = 0; i < width * height; ++i) map.texels.emplace_back(value(random), value(random), value(random));
  map.texels[static_cast<std::size_t>(width + 2)] = vec3(60.0f);  // a sun
  for (int x = 0; x < width; ++x) map.texels[static_cast<std::size_t>(width * (height - 1) + x)] = vec3(0.0f);
  return map;
}

TEST_F(Environments, DrawDirectionsWithTheStatedDensity) {
  constexpr int kSamples = 200'000;
  for (const EnvironmentMap& map : {randomMap(12, 6), randomMap(7, 5), EnvironmentMap{1, 1, {vec3(2.0f)}}}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 0.99999994f);
    std::vector<Query> queries(kSamples);
    for (Query& q : queries) q.u = vec2(unit(random), unit(random));
    // The density is constant over each of the map's texels, and so it is over each quarter of one.
    const auto cells = static_cast<std::size_t>(map.width * map.height);
    std::vector<double> counts(4 * cells), expected(4 * cells);
    std::vector<Query> centres(cells);
    for (const Answer& a : ask(map, queries)) {
      const double azimuth =
          0.5 + std::atan2(static_cast<double>(a.sampled.x), -static_cast<double>(a.sampled.z)) / (2 * M_PI);
      const double height = std::acos(std::clamp(static_cast<double>(a.sampled.y), -1.0, 1.0)) / M_PI;
      const int x = std::min(static_cast<int>(azimuth * 2 * map.width), 2 * map.width - 1);
      const int y = std::min(static_cast<int>(height * 2 * map.height), 2 * map.height - 1);
      ++counts[static_cast<std::size_t>(y * 2 * map.width + x)];
      ASSERT_NEAR(glm::length(a.sampled), 1, 1e-5);
      ASSERT_GT(a.sampledPdf, 0);
    }
    for (std::size_t i = 0; i < cells; ++i) {
      const auto width = static_cast<std::size_t>(map.width);
      const double azimuth = 2 * M_PI * ((static_cast<double>(i % width) + 0.5) / map.width - 0.5);
      const double height = M_PI * (static_cast<double>(i / width) + 0.5) / map.height;
      centres[i].direction =
          vec3(std::sin(height) * std::sin(azimuth), std::cos(height), -std::sin(height) * std::cos(azimuth));
    }
    const auto answers = ask(map, centres);
    double sum = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      const int row = static_cast<int>(i) / map.width, column = static_cast<int>(i) % map.width;
      for (int half = 0; half < 2; ++half) {  // the upper, the lower
        const double top = std::cos(M_PI * (row + 0.5 * half) / map.height),
                     bottom = std::cos(M_PI * (row + 0.5 * half + 0.5) / map.height);
        const double quarter = static_cast<double>(answers[i].pdf) * M_PI / map.width * (top - bottom);
        const auto left = static_cast<std::size_t>((2 * row + half) * 2 * map.width + 2 * column);
        expected[left] = expected[left + 1] = quarter * kSamples;
        sum += 2 * quarter;
      }
      const vec3 texel = map.texels[i];
      // In its centre the texel shows alone, but for a thousandth, as far as devices round arcs, of the sun
      // beside it.
      ASSERT_NEAR(glm::length(answers[i].radiance - texel), 0, 1e-3 * glm::length(vec3(60.0f)));
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    for (double& e : expected) e /= sum;
    EXPECT_GT(test::chiSquareTest(counts, expected).pValue, 1e-4);
  }
}

// Points that are even over the square are even over the map, then: fewer samples have the same error.
TEST_F(Environments, AreDrawnInTheOrderOfU) {
  constexpr int kSteps = 500;
  const EnvironmentMap map = randomMap(12, 6);
  std::vector<Query> queries;
  for (const float other : {0.1f, 0.5f, 0.9f}) {
    for (int i = 0; i < kSteps; ++i)
      queries.push_back({vec2(other, (static_cast<float>(i) + 0.5f) / kSteps), vec3(0, 1, 0)});
    for (int i = 0; i < kSteps; ++i)
      queries.push_back({vec2((static_cast<float>(i) + 0.5f) / kSteps, other), vec3(0, 1, 0)});
  }
  const std::vector<Answer> answers = ask(map, queries);
  const auto azimuth = [](const Answer& a) { return std::atan2(a.sampled.x, -a.sampled.z); };
  for (std::size_t i = 1; i < answers.size(); ++i) {
    if (i % kSteps == 0) continue;
    if (i / kSteps % 2 == 0)
      EXPECT_LT(answers[i].sampled.y, answers[i - 1].sampled.y) << i;
    else
      EXPECT_GT(azimuth(answers[i]), azimuth(answers[i - 1])) << i;
  }
}

// The top is +y, the middle looks along -z, the right half to +x.
TEST_F(Environments, StandAsDocumented) {
  EnvironmentMap map{4, 2, std::vector<vec3>(8, vec3(0.0f))};
  map.texels[1] = vec3(1, 0, 0);  // above, left of the middle: towards -x -z
  map.texels[6] = vec3(0, 1, 0);  // below, right of it
  const float s = std::sqrt(0.25f), c = std::sqrt(0.5f);
  const auto answers =
      ask(map, {{vec2(0.5f), vec3(-s, c, -s)}, {vec2(0.5f), vec3(s, -c, -s)}, {vec2(0.5f), vec3(s, c, s)}});
  EXPECT_NEAR(answers[0].radiance.x, 1, 1e-4);
  EXPECT_NEAR(answers[1].radiance.y, 1, 1e-4);
  EXPECT_NEAR(glm::length(answers[2].radiance), 0, 1e-4);
}

TEST_F(Environments, OfOneTexelAreConstant) {
  for (const Answer& a :
       ask({1, 1, {vec3(0.7f)}}, {{vec2(0.1f, 0.9f), vec3(1, 0, 0)}, {vec2(0.6f, 0.2f), vec3(0, -1, 0)}})) {
    EXPECT_EQ(a.radiance, vec3(0.7f));
    EXPECT_NEAR(a.pdf * 4 * M_PI, 1, 1e-6);
  }
}

}  // namespace
}  // namespace importon::environment_test
