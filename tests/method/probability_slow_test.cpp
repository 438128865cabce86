// Storage by probability changes no image in the mean.
#include <gtest/gtest.h>

#include "method/render_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon {
namespace {

using test::SceneBuilder;

constexpr double kSignificance = 1e-3;  // two-sided

/// A room whose camera sees one corner of it.
Scene room() {
  SceneBuilder builder;
  const uint white = builder.material(test::diffuse(vec3(0.7f)));
  builder.box(white, {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
  builder.square(builder.material(test::emitter(vec3(5, 4, 3))), {0, 0.99, 0}, {0, -1, 0}, 0.5);
  builder.camera({0.5, -0.5, 0.5}, {1, -1, 1}, 0.8, 12, 12);
  return builder.finish();
}

class ProbabilityImage : public test::GpuTest {};

TEST_F(ProbabilityImage, RendersTheMeanOfTheUncontrolledMap) {
  const Scene scene = room();
  test::Moments thinned, all;
  double stored = 0, hits = 0;
  for (uint seed = 0; seed < 10; ++seed) {
    RenderJob job;
    job.passes = 1;
    job.photons = 1u << 15;
    job.importons = 1u << 10;
    job.globalDensity = 0.2;
    job.gather = 16;
    job.filtersIndirect = false;
    job.emission = EmissionChoice::power;
    job.control = DensityControl::probability;
    job.seed = seed;
    const RenderResult result = test::renderScene(scene, job);
    thinned.add(test::meanOf(result));
    stored += static_cast<double>(result.stats.global.stored);
    hits += static_cast<double>(result.stats.global.hits);
    job.control = DensityControl::off;
    job.seed = seed + 100;
    all.add(test::meanOf(test::renderScene(scene, job)));
  }
  EXPECT_LT(stored, 0.7 * hits);
  EXPECT_GT(test::welchTest(thinned, all).pValue, kSignificance)
      << thinned.mean() << " +- " << thinned.standardError() << ", " << all.mean() << " +- " << all.standardError();
}

}  // namespace
}  // namespace importon
