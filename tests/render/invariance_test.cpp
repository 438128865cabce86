// Images that must be equal, to the last bit or in the mean.
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

#include "render_helper.h"

namespace importon::test::invariance_test {
namespace {

constexpr int kSize = 16;

class Invariance : public RenderTest, public ::testing::WithParamInterface<Integrator> {
 protected:
  [[nodiscard]] RenderJob job() const { return makeJob(GetParam(), 2); }
};

/// A room with a glass ball, a mirror, an area light and a point light, whose emissions are multiplied.
SceneBuilder room(const vec3& area, const vec3& point) {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(mirror(vec3(0.9f))), {-0.9, 0, 0}, {1, 0.1, 0}, 0.7);
  builder.icosphere(builder.material(glass(1.5f)), {0.3, -0.5, -0.2}, 0.35, 2, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(area)), {0, 0.9, 0}, {0, -1, 0}, 0.6);  // it is there too when it is dark
  if (point != vec3(0.0f)) builder.pointLight({-0.4, 0.3, 0.5}, point);
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
  return builder;
}

TEST_P(Invariance, TwiceTheLightIsTwiceTheImage) {
  const StabilityCase listed(22, "all lights times 2", "the image times 2");
  const Image once = renderScene(job(), room(vec3(3, 2, 1), vec3(0.3f)).finish()).image;
  Image twice = renderScene(job(), room(vec3(6, 4, 2), vec3(0.6f)).finish()).image;
  for (Channel& channel : twice.channels)
    for (float& value : channel.values) value *= 0.5f;
  EXPECT_TRUE(haveSameBits(once, twice));
}

TEST_P(Invariance, WorkgroupsOfAnySizeGiveTheSameBits) {
  const StabilityCase listed(30, "other workgroup sizes", "the same bits");
  const Scene scene = room(vec3(3, 2, 1), vec3(0.3f)).finish();
  const Image usual = renderScene(job(), scene).image;
  for (const std::uint32_t size : {8u, 32u, 128u}) {
    RenderJob other = job();
    other.workgroupSize = size;
    EXPECT_TRUE(haveSameBits(usual, renderScene(other, scene).image)) << "workgroups of " << size;
  }
}

TEST_P(Invariance, ChannelsDoNotMix) {
  StabilityCase listed(23, "light of (1, 1e-6, 0)", "blue 0, green within 1 %");
  const Image image = renderScene(job(), room(vec3(3, 3e-6f, 0), vec3(0.3f, 0.3e-6f, 0)).finish()).image;
  for (const float blue : valuesOf(image, "B")) ASSERT_EQ(blue, 0.0f);
  EXPECT_NEAR(meanOf(image, "G") / meanOf(image, "R"), 1e-6, 1e-8);
  EXPECT_GT(meanOf(image, "R"), 0);
  listed.note("blue 0", 1);
}

TEST_P(Invariance, ScaledSceneGivesTheSameBits) {
  const StabilityCase listed(8, "the scene times 2^-13 to 2^20", "the same bits");
  const Image unscaled = renderScene(job(), room(vec3(3, 2, 1), vec3(0.3f)).finish()).image;
  for (const int k : {-13, -3, 6, 20}) {
    const double scale = std::ldexp(1.0, k);
    SceneBuilder builder = room(vec3(3, 2, 1), vec3(static_cast<float>(0.3f * scale * scale)));
    builder.transform(glm::scale(glm::dmat4(1.0), glm::dvec3(scale)));
    EXPECT_TRUE(haveSameBits(unscaled, renderScene(job(), builder.finish()).image)) << "2^" << k;
  }
}

TEST_P(Invariance, SameJobGivesTheSameBits) {
  StabilityCase listed(30, "the same seed twice", "the same bits");
  const Scene scene = room(vec3(3, 2, 1), vec3(0.3f)).finish();
  const Rendered a = renderScene(job(), scene), b = renderScene(job(), scene);
  EXPECT_TRUE(haveSameBits(a.image, b.image));
  EXPECT_EQ(a.stats.global.stored, b.stats.global.stored);
  RenderJob other = job();
  other.seed = 1;
  EXPECT_FALSE(haveSameBits(a.image, renderScene(other, scene).image));
  listed.note("equal", 1);
}

TEST_P(Invariance, ThreadsDoNotChangeTheBits) {
  const StabilityCase listed(30, "other numbers of threads", "the same bits");
  const Scene scene = room(vec3(3, 2, 1), vec3(0.3f)).finish();
  const auto renderWith = [&](const char* threads) {
    setenv("LP_NUM_THREADS", threads, 1);  // read by lavapipe for every new instance; without meaning to GPUs
    RenderJob settings = job();
    settings.threads = std::atoi(threads) + 1;
    return renderScene(settings, scene).image;
  };
  const Image one = renderWith("1"), three = renderWith("3");
  unsetenv("LP_NUM_THREADS");
  EXPECT_TRUE(haveSameBits(one, three));
}

TEST_P(Invariance, AllFeaturesTogetherGiveTheSameImage) {
  SceneBuilder builder;
  builder.box(builder.material(emitter(vec3(1.0f), false, vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
  const Scene scene = builder.finish();
  RenderJob all = job();
  all.forcesAllFeatures = true;
  const Image lean = renderScene(job(), scene).image, full = renderScene(all, scene).image;
  for (std::size_t i = 0; i < lean.channels[0].values.size(); ++i)  // float rounding of other machine code
    ASSERT_NEAR(lean.channels[0].values[i], full.channels[0].values[i], 1e-4f * lean.channels[0].values[i]) << i;
}

TEST_P(Invariance, TwoLightsGiveTheSumOfEach) {
  const StabilityCase listed(36, "two lights, and each alone", "the sum");
  const bool isPath = GetParam() == Integrator::path;
  RenderJob settings = makeJob(GetParam(), isPath ? 4 : 2);
  settings.gather = isPath ? 256 : 64;
  settings.photons = 1u << 15;
  const auto meanOfLights = [&](const vec3& area, const vec3& point, std::uint32_t seed) {
    settings.seed = seed;
    return meanOf(renderScene(settings, room(area, point).finish()).image);
  };
  Moments both, sum;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    both.add(meanOfLights(vec3(3.0f), vec3(0.3f), seed));
    sum.add(meanOfLights(vec3(3.0f), vec3(0.0f), 100 + seed) + meanOfLights(vec3(0.0f), vec3(0.3f), 200 + seed));
  }
  EXPECT_TRUE(areWithin(0.02, both, sum));
}

INSTANTIATE_TEST_SUITE_P(Both, Invariance, ::testing::Values(Integrator::path, Integrator::photon),
                         [](const auto& test) { return test.param == Integrator::path ? "Path" : "Photon"; });

}  // namespace
}  // namespace importon::test::invariance_test
