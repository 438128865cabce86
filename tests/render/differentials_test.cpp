// Path differentials as importance: they decide which photons are stored, and nothing else.
#include <gtest/gtest.h>

#include "render_helper.h"
#include "support/scene_builder.h"

namespace importon::test {
namespace {

class Differentials : public RenderTest {};

/// A room with a glass ball; the camera sees the floor by it.
Scene glassRoom() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(10))), {0.2, 0.98, 0.1}, {0, -1, 0}, 0.4);
  builder.icosphere(builder.material(glass(1.5f)), {-0.3, -0.6, 0.1}, 0.3, 3, Facing::outside, Shading::smooth);
  builder.camera({-0.3, 0, 0.9}, {-0.35, -1, 0.05}, 0.6, 24, 24);
  return builder.finish();
}

TEST_F(Differentials, ChangeWhatIsStoredButNotThePower) {
  const Scene scene = glassRoom();
  RenderJob job = makeJob(Integrator::photon, 1);
  job.emission = EmissionChoice::power;
  job.gatherFrom = GatherSource::photons;
  const RenderStats map = renderScene(job, scene).stats;
  job.importance = ImportanceChoice::differentials;
  job.differentialBound = DifferentialBound::pixel;
  const Rendered rendered = renderScene(job, scene);
  const RenderStats& pixel = rendered.stats;
  EXPECT_TRUE(isSane(rendered.image));
  EXPECT_EQ(pixel.caustic.hits, map.caustic.hits);
  EXPECT_EQ(pixel.global.hits, map.global.hits);
  EXPECT_NE(pixel.caustic.stored, map.caustic.stored);
  EXPECT_EQ(pixel.caustic.fluxMap, map.caustic.fluxMap) << "to the last bit of the fixed point";
  EXPECT_EQ(pixel.global.fluxMap, map.global.fluxMap);
}

}  // namespace
}  // namespace importon::test
