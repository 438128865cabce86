// More camera paths where the image is noisier: the same mean, less noise.
#include "render_helper.h"

namespace importon::test {
namespace {

class Adaptive : public RenderTest {};

constexpr int kPasses = 9;

/// A lamp over a floor with a plate between them: a narrow penumbra, and edges.
Scene plateOverFloor() {
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.7f))), {0, 0, 0}, {0, 1, 0}, 8);
  builder.square(builder.material(diffuse(vec3(0.2f))), {0, 0.5, 0}, {0, 1, 0}, 0.8);
  builder.square(builder.material(emitter(vec3(30))), {0, 3, 0}, {0, -1, 0}, 0.4);
  builder.camera({0, 1.5, 4}, {0, 0.2, 0}, 0.7, 24, 24);
  return builder.finish();
}

/// With as many paths per pass as the renderer chooses.
RenderJob adaptiveJob(bool isAdaptive) {
  RenderJob job = makeJob(Integrator::photon, kPasses);
  job.gather.reset();
  job.isAdaptive = isAdaptive;
  return job;
}

TEST_F(Adaptive, PathsKeepTheMeanOfEveryPixelAndLowerItsNoise) {
  const Scene scene = plateOverFloor();
  constexpr int kSeeds = 10;
  std::vector<Moments> pixels[2];
  Moments image[2];
  for (const bool isAdaptive : {false, true}) {
    RenderJob job = adaptiveJob(isAdaptive);
    for (job.seed = 1; job.seed <= kSeeds; ++job.seed) {
      const std::vector<float> values = valuesOf(renderScene(job, scene).image);
      pixels[isAdaptive].resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) pixels[isAdaptive][i].add(static_cast<double>(values[i]));
      image[isAdaptive].add(momentsOf(values).mean());
    }
  }
  EXPECT_TRUE(areWithin(0.01, image[1], image[0]));
  const int tests = static_cast<int>(pixels[0].size());
  double variance[2] = {};
  for (std::size_t i = 0; i < pixels[0].size(); ++i) {
    EXPECT_TRUE(haveSameMean(pixels[0][i], pixels[1][i], tests)) << "pixel " << i;
    for (const int way : {0, 1}) variance[way] += pixels[way][i].variance();
  }
  EXPECT_LT(variance[1], 0.6 * variance[0]);
}

TEST_F(Adaptive, PathsAreEvenWhereAllPixelsAreAlike) {
  SceneBuilder builder;
  builder.box(builder.material(emitter(vec3(2))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.camera({0, 0, 0}, {0, 0, -1}, 1.0, 24, 24);
  const Rendered rendered = renderScene(adaptiveJob(true), builder.finish());
  EXPECT_TRUE(isConstant(rendered.image, 2, 1e-6));
  EXPECT_NEAR(static_cast<double>(rendered.stats.closestRays), 4 * 24 * 24 * kPasses, kPasses);
}

}  // namespace
}  // namespace importon::test
