// Storage by probability changes no image in the mean, against the classical map of the same photons.
#include <gtest/gtest.h>

#include "method/paired_render.h"
#include "support/claims.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon {
namespace {

using test::SceneBuilder;

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
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 16;
  job.importons = 1u << 10;
  job.globalDensity = 0.2;
  job.gather = 16;
  job.sharesLight = false;
  job.emission = EmissionChoice::power;
  job.gatherFrom = GatherSource::photons;
  job.control = DensityControl::probability;
  const test::PairedFigures found = test::judgeAgainstClassicalMap(room(), {job}, 16, MapKind::global).front();
  EXPECT_TRUE(test::isAbove(2, found.timesFewer));
  EXPECT_TRUE(test::isWithin(0.01, found.meanRatio, 1));
}

}  // namespace
}  // namespace importon
