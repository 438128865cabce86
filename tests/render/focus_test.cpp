// Where light is brought together: a ball of glass and an ellipsoid mirror; and lights of very different
// strength.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::focus_test {
namespace {

constexpr int kSize = 16;

class Focus : public RenderTest {};

/// What an orthographic camera sees along the axis of a ball of glass of radius 1: a small emitter behind it,
/// at this distance from the centre. The image spans 0.08 to each side of the axis.
Image throughBall(double distance) {
  SceneBuilder builder;
  builder.icosphere(builder.material(glass(1.5f)), {0, 0, 0}, 1, 6, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(vec3(1.0f))), {0, 0, -distance}, {0, 0, 1}, 0.02);
  builder.camera({0, 0, 5}, {0, 0, 0}, 0.1, kSize, kSize);
  Scene scene = builder.finish();
  scene.cameras[0].isOrthographic = true;
  scene.cameras[0].xmag = scene.cameras[0].ymag = 0.08;
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 64;
  return renderScene(job, scene).image;
}

/// Case 17: rays near the axis meet n / (2 (n - 1)) = 1.5 radii behind the centre. There, all see the emitter,
/// but for what the two surfaces turn back; half-way to the ball a square of a fifth of the side does.
TEST_F(Focus, OfGlassBallLiesThreeQuartersOfItsDiameterBehindTheCentre) {
  StabilityCase listed(17, "a glass ball, index 1.5", "paraxial focus at 0.75 diameters");
  EXPECT_TRUE(isWithin(0.01, momentsOf(valuesOf(throughBall(1.5))), 0.96 * 0.96));
  EXPECT_LT(meanOf(throughBall(1.25)), 0.9 * 0.96 * 0.96);
  EXPECT_LT(meanOf(throughBall(1.75)), 0.9 * 0.96 * 0.96);
  listed.note("there", 1);
}

/// Case 18: an ellipsoid mirror sends all light of one focus to the other one, where a speck catches it.
TEST_F(Focus, OfEllipsoidMirrorKeepsPowerInOnePoint) {
  const StabilityCase listed(18, "ellipsoid mirror, light in a focus", "finite, power exact");
  SceneBuilder builder;
  builder.icosphere(builder.material(mirror()), {0, 0, 0}, 1, 5, Facing::inside, Shading::flat);
  builder.icosphere(builder.material(diffuse(vec3(0.5f))), {0.6, 0, 0}, 0.06, 1, Facing::outside, Shading::flat);
  builder.pointLight({-0.75, 0, 0}, vec3(1.0f));
  builder.camera({0.3, 0.1, 0}, {0.75, 0, 0}, 0.3, kSize, kSize);
  Scene scene = builder.finish();
  for (vec3& position : scene.positions) position.x *= 1.25f;  // semi-axes 1.25, 1 and 1: foci at ±0.75
  scene.boundsMin.x *= 1.25f;
  scene.boundsMax.x *= 1.25f;
  for (const DensityControl control : {DensityControl::off, DensityControl::density}) {
    RenderJob job = makeJob(Integrator::photon, 2);
    job.control = control;
    const Rendered r = renderScene(job, scene);
    EXPECT_TRUE(isSane(r.image));
    EXPECT_EQ(r.stats.caustic.fluxMap, r.stats.caustic.fluxHits);
    // All of the light, 4 pi W, comes; some more than once, as the speck scatters it into the mirror again.
    EXPECT_GT(r.stats.caustic.fluxHits[0], 0.8 * 4 * glm::pi<double>());
  }
}

/// Case 21: two floors, a wall between them, and a light over each, one 1e8 times as strong.
TEST_F(Focus, WeakLightIsSeenWhereTheStrongOneIsHidden) {
  const StabilityCase listed(21, "lights of ratio 1 : 1e8", "the region of the weak one analytic");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 8);
  builder.square(builder.material(diffuse(vec3(0.0f))), {0, 0, 0}, {1, 0, 0}, 8);
  builder.square(builder.material(diffuse(vec3(0.0f))), {-0.01, 0, 0}, {-1, 0, 0}, 8);
  builder.pointLight({2, 1, 0}, vec3(1.0f));
  builder.pointLight({-2, 1, 0}, vec3(1e8f));
  builder.camera({2, 2, 2}, {2, 0, 0}, 0.01, kSize, kSize);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    RenderJob job = makeJob(integrator, 1);
    job.gather = 1024;
    const Moments values = momentsOf(valuesOf(renderScene(job, builder.finish()).image));
    EXPECT_TRUE(isWithin(0.02, values, 1 / glm::pi<double>()));
  }
}

}  // namespace
}  // namespace importon::test::focus_test
