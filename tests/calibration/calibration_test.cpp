// The estimated error against the true one, over scenes and seeds. The references are long renders
// without sharing of light: of the path tracer where it can find the light, else of the photon map; see
// tests/data/calibration/README.md.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "gpu/context.h"
#include "io/image.h"
#include "render/render.h"
#include "report/compare.h"
#include "scene/gltf_loader.h"

namespace importon {
namespace {

constexpr int kSeeds = 10;

struct SceneOfTest {
  const char* name;
  int width;                  // pixels
  std::optional<int> height;  // if not by the camera
  std::uint32_t photons;      // per pass
};

// glass_caustic has a dozen pixels that see the lamp in mirrors: a hit in a thousand paths, which no estimate knows
// before it happens. So wide, they are within the thousandth of the pixels that the error leaves out.
constexpr SceneOfTest kScenes[] = {{"cornell_box", 40, {}, 1u << 15}, {"rooms", 40, {}, 1u << 15},
                                   {"ring", 40, {}, 1u << 15},        {"pool", 40, {}, 1u << 15},
                                   {"door_slit", 64, 64, 1u << 15},   {"glass_caustic", 128, {}, 1u << 17}};

RenderJob jobFor(const SceneOfTest& scene, std::uint32_t seed) {
  RenderJob job;
  job.width = scene.width;
  job.height = scene.height;
  job.error = 0.15;
  job.photons = scene.photons;
  job.importons = 1u << 12;
  job.seed = seed;
  return job;
}

struct Outcome {
  double estimated = 0, truth = 0;
  int passes = 0;
  bool isHeld = false;  // in the stated band
};

Outcome renderOnce(const RenderJob& job, const Scene& scene, const Image& reference) {
  Log log(Log::Verbosity::quiet);
  const std::atomic<bool> isInterrupted = false;
  const RenderResult result = render(
      job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now());
  const ErrorStats& error = result.stats.error;
  const double truth = std::sqrt(compareValues(result.image, "the image", reference, "the reference").relmseTrimmed);
  return {*error.estimated, truth, result.stats.passes, *error.low <= truth && truth <= *error.high};
}

/// Ten seeds of a scene; returns how many renders had their true error within the band.
int countHeld(const SceneOfTest& tested) {
  const std::string name = tested.name;
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(std::string(IMPORTON_SCENES) + "/" + name + "/" + name + ".gltf", log);
  const Image reference = readExr(std::string(IMPORTON_REFERENCES) + "/" + name + ".exr");
  int held = 0;
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const Outcome outcome = renderOnce(jobFor(tested, seed), scene, reference);
    std::printf("%s, seed %u: %d passes, estimated %.4f, true %.4f, ratio %.2f%s\n", name.c_str(), seed, outcome.passes,
                outcome.estimated, outcome.truth, outcome.truth / outcome.estimated,
                outcome.isHeld ? "" : ", outside the band");
    std::fflush(stdout);
    held += outcome.isHeld ? 1 : 0;
  }
  return held;
}

TEST(Calibration, TheTrueErrorLiesInTheBandAsOftenAsStated) {
  int held = 0, all = 0;
  for (const SceneOfTest& scene : kScenes) {
    held += countHeld(scene);
    all += kSeeds;
  }
  RecordProperty("held", held);
  std::printf("%d of %d in the band\n", held, all);
  EXPECT_GE(held, all * 80 / 100);
  EXPECT_LE(held, all * 97 / 100);
}

}  // namespace
}  // namespace importon
