// The talk's claims in small, with gathers that read photons: density control changes neither the mean nor the error of
// an image, in a lit room and behind a door. The same of surface cells, which gathers read by default. Errors are
// against the path tracer.
#include <gtest/gtest.h>

#include <cmath>

#include "method/paired_render.h"
#include "support/claims.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon {
namespace {

using test::SceneBuilder;

constexpr double kMostError = 1.15;  // of the controlled image, over that of the uncontrolled one

/// Two rooms and a door between them that is open by a slit; the lamp in one of them. The camera sees a corner of the
/// lit room, or what is behind the door.
Scene twoRooms(bool isBehindTheDoor) {
  SceneBuilder builder;
  const uint white = builder.material(test::diffuse(vec3(0.6f)));
  const uint red = builder.material(test::diffuse(vec3(0.6f, 0.3f, 0.2f)));
  builder.box(white, {-2, -1, -1}, {2, 1, 1}, test::Facing::inside);
  builder.box(red, {-0.05, -1, -1}, {0.05, 1, 0.8}, test::Facing::outside);  // the wall, a slit of 20 cm beside it
  builder.square(builder.material(test::emitter(vec3(40, 36, 30))), {1, 0.98, 0}, {0, -1, 0}, 0.4);
  if (isBehindTheDoor) builder.camera({-0.3, 0.2, -0.7}, {-1.5, -0.4, 0.6}, 1.0, 16, 12);
  else builder.camera({0.4, 0, -0.6}, {1.6, -0.6, 0.6}, 1.0, 16, 12);
  return builder.finish();
}

RenderJob photonJob() {
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 16;
  job.importons = 1u << 13;
  job.maxDepth = 8;
  job.gather = 4;
  job.filtersIndirect = false;
  job.emission = EmissionChoice::power;
  job.gatherFrom = GatherSource::photons;
  return job;
}

RenderJob pathJob() {
  RenderJob job = photonJob();
  job.integrator = Integrator::path;
  job.passes = 4;
  job.gather = 64;
  job.seed = 1000;
  return job;
}

class TalkClaims : public test::GpuTest {};

TEST_F(TalkClaims, ASeventhOfThePhotonsMakesTheSameImageOfALitRoom) {
  const Scene scene = twoRooms(false);
  const test::ReferenceHalves paths = test::renderHalves(scene, pathJob());
  RenderJob cells = photonJob();
  cells.gatherFrom = GatherSource::cells;
  const auto found = test::judgeAgainstClassicalMap(scene, {photonJob(), cells}, 8, MapKind::global, &paths);
  for (const test::PairedFigures& f : found) {
    std::printf("%s\n", test::describe(f).c_str());
    EXPECT_TRUE(test::isAbove(7, f.timesFewer));
    EXPECT_TRUE(test::isWithin(0.01, f.meanRatio, 1));
    EXPECT_TRUE(test::isBelow(std::log(kMostError), f.errorRatio));
  }
  EXPECT_TRUE(test::isBelow(0.5, found[1].bytesRatio));
}

TEST_F(TalkClaims, NoLightIsHandedThroughTheDoor) {
  RenderJob job = photonJob();
  job.photons = 1u << 15;
  job.gather = 8;
  const auto found = test::judgeAgainstClassicalMap(twoRooms(true), {job}, 8, MapKind::global).front();
  std::printf("%s\n", test::describe(found).c_str());
  EXPECT_TRUE(test::isAbove(3, found.timesFewer));
  EXPECT_TRUE(test::isWithin(0.03, found.meanRatio, 1));
}

}  // namespace
}  // namespace importon
