// The talk's figures: density control saves photons, not accuracy; and no light crosses a step of importance.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "method/render_scene.h"
#include "scene/gltf_loader.h"
#include "support/gpu_test.h"
#include "support/statistics.h"

namespace importon {
namespace {

class TalkFigures : public test::GpuTest {
 protected:
  static Scene load(const std::string& name) {
    Log log(Log::Verbosity::quiet);
    return loadGltf(std::filesystem::path(IMPORTON_SCENES) / name / (name + ".gltf"), log);
  }

  static RenderJob talkJob(int width, int height) {
    RenderJob job;
    job.width = width;
    job.height = height;
    job.passes = 1;
    job.importons = 80'000;
    job.photons = 400'000;
    return job;
  }
};

struct Pair {
  RenderResult controlled, uncontrolled;
};

Pair renderBoth(const Scene& scene, RenderJob job) {
  Pair pair;
  job.control = DensityControl::density;
  pair.controlled = test::renderScene(scene, job);
  job.control = DensityControl::off;
  pair.uncontrolled = test::renderScene(scene, job);
  return pair;
}

double share(const PhotonMapStats& controlled, const PhotonMapStats& uncontrolled) {
  return static_cast<double>(controlled.stored) / static_cast<double>(uncontrolled.stored);
}

/// What both are measured against: many passes without density control.
RenderResult reference(const Scene& scene, RenderJob job, int passes) {
  job.control = DensityControl::off;
  job.passes = passes;
  job.photons = 100'000;
  job.seed = 1000;
  return test::renderScene(scene, job);
}

/// Holds the controlled image against the uncontrolled one: means within 1 %, error at most 1.15 times as large.
void expectLikeImages(const Scene& scene, RenderJob job, const char* name, bool filtersIndirect) {
  job.passes = 4;
  job.gather = 16;  // so that the gather's own noise, which both share, hides little
  job.filtersIndirect = filtersIndirect;
  const Pair pair = renderBoth(scene, job);
  job.gather = 32;
  const RenderResult truth = reference(scene, job, 16);
  const double error = test::relativeError(pair.controlled, truth), errorWithout = test::relativeError(pair.uncontrolled, truth);
  const double mean = test::meanOf(pair.controlled) / test::meanOf(pair.uncontrolled);
  std::printf("%s%s: error %.6f against %.6f, mean %.4f\n", name, filtersIndirect ? ", filtered" : "", error, errorWithout, mean);
  EXPECT_NEAR(mean, 1, 0.01);
  EXPECT_LT(error, 1.15 * errorWithout);
}

TEST_F(TalkFigures, RoomsNeedASeventhOfTheGlobalPhotons) {
  const Scene scene = load("rooms");
  const RenderJob job = talkJob(96, 72);
  const Pair pair = renderBoth(scene, job);
  const double part = share(pair.controlled.stats.global, pair.uncontrolled.stats.global);
  std::printf("rooms: global photons %.4f (%llu of %llu)\n", part,
              static_cast<unsigned long long>(pair.controlled.stats.global.stored),
              static_cast<unsigned long long>(pair.uncontrolled.stats.global.stored));
  EXPECT_LT(part, 1.0 / 7);
  for (const bool filtersIndirect : {true, false}) expectLikeImages(scene, job, "rooms", filtersIndirect);
}

TEST_F(TalkFigures, GlassNeedsHalfOfTheCausticPhotons) {
  const Scene scene = load("glass_caustic");
  const RenderJob job = talkJob(96, 72);
  const Pair pair = renderBoth(scene, job);
  const double part = share(pair.controlled.stats.caustic, pair.uncontrolled.stats.caustic);
  std::printf("glass: caustic photons %.4f (%llu of %llu)\n", part,
              static_cast<unsigned long long>(pair.controlled.stats.caustic.stored),
              static_cast<unsigned long long>(pair.uncontrolled.stats.caustic.stored));
  EXPECT_LT(part, 0.5);
  expectLikeImages(scene, job, "glass", true);
}

TEST_F(TalkFigures, NoLightComesThroughTheDoorByRedistribution) {
  const Scene scene = load("door_slit");
  test::Moments ratios;
  for (uint seed = 0; seed < 4; ++seed) {
    RenderJob job;
    job.width = job.height = 64;
    job.passes = 4;
    job.photons = 100'000;
    job.importons = 1u << 14;
    job.seed = seed;
    const Pair pair = renderBoth(scene, job);
    ratios.add(test::meanOf(pair.controlled) / test::meanOf(pair.uncontrolled));
  }
  std::printf("door_slit: mean ratio %.4f +- %.4f\n", ratios.mean(), ratios.standardError());
  const bool isWithinOnePercent = std::abs(ratios.mean() - 1) < 0.01;
  EXPECT_TRUE(isWithinOnePercent || test::tTest(ratios, 1).pValue > 0.01) << ratios.mean();
}

}  // namespace
}  // namespace importon
