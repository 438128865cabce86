// Where a guide cannot help it notices, and stays off: at equal photons its error is never more than 1.1 times that of
// emission by power, in a door slit (whose light comes by few paths) and in a box of which everything is seen.
#include <gtest/gtest.h>

#include <filesystem>

#include "method/render_scene.h"
#include "scene/gltf_loader.h"
#include "support/claims.h"
#include "support/gpu_test.h"

namespace importon {
namespace {

class GuideGain : public test::GpuTest {};

RenderJob gainJob(int passes) {
  RenderJob job;
  job.width = job.height = 48;
  job.passes = passes;
  job.photons = 1u << 13;
  job.importons = 1u << 14;
  return job;
}

/// Errors of emission that is guided whatever it promises, less 1.1 times those by power, over seeds.
test::Moments excessError(const Scene& scene, int seeds) {
  RenderJob job = gainJob(64);
  job.photons = 1u << 16;
  job.seed = 1000;
  const RenderResult reference = test::renderScene(scene, job);
  test::Moments excess;
  for (job.seed = 1; job.seed <= static_cast<std::uint32_t>(seeds); ++job.seed) {
    RenderJob run = gainJob(4);
    run.seed = job.seed;
    run.emission = EmissionChoice::power;
    const double byPower = test::relativeError(test::renderScene(scene, run), reference);
    run.emission = EmissionChoice::guided;
    excess.add(test::relativeError(test::renderScene(scene, run), reference) - 1.1 * byPower);
  }
  return excess;
}

TEST_F(GuideGain, IsNeverALossOfMoreThanATenth) {
  for (const char* name : {"cornell_box", "door_slit"}) {
    Log log(Log::Verbosity::quiet);
    const Scene scene = loadGltf(std::filesystem::path(IMPORTON_SCENES) / name / (std::string(name) + ".gltf"), log);
    EXPECT_TRUE(test::isBelow(0, excessError(scene, 24))) << name;
  }
}

}  // namespace
}  // namespace importon
