// Scenes whose result is known, or is the same with and without something.
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::closed_form_test {
namespace {

constexpr int kSize = 12;

class ClosedForms : public RenderTest {};

/// Photons of one colour die by that of their strongest channel; the others must keep their means.
TEST_F(ClosedForms, SlowRouletteKeepsTheMeanOfEveryChannel) {
  const StabilityCase listed(39, "photons by roulette in a coloured room", "power / (1 - albedo), as without roulette");
  const vec3 albedo(0.75f, 0.5f, 0.25f);
  SceneBuilder builder;
  builder.box(builder.material(diffuse(albedo)), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.pointLight({0.3, 0.2, 0.1}, vec3(1.0f, 2.0f, 3.0f));
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
  RenderJob job = makeJob(Integrator::photon, 1);
  job.maxDepth = 40;
  job.photons = 1u << 15;
  const auto power = [](const Rendered& r) {
    return std::vector<double>{r.stats.global.fluxHits[0], r.stats.global.fluxHits[1], r.stats.global.fluxHits[2]};
  };
  const std::vector<Moments> found = overSeeds(job, builder.finish(), 8, power);
  for (int c = 0; c < 3; ++c) {
    const double emitted = 4 * glm::pi<double>() * (c + 1);
    EXPECT_TRUE(isWithin(0.02, found[static_cast<std::size_t>(c)], emitted / (1 - static_cast<double>(albedo[c]))))
        << c;
  }
}

/// Two floors in one plane, one of them a mirror image of the other, light above and the camera below.
TEST_F(ClosedForms, CoplanarSurfacesLetNoLightThrough) {
  StabilityCase listed(13, "two coplanar surfaces", "the dark side exactly 0");
  SceneBuilder builder;
  const uint grey = builder.material(diffuse(vec3(0.8f)));
  builder.square(grey, {0, 0, 0}, {0, 1, 0}, 8);
  builder.square(grey, {0.1, 0, 0.2}, {0, -1, 0}, 8, 3);
  builder.box(grey, {-1, -1, -1}, {1, -0.1, 1}, Facing::inside);
  builder.pointLight({0.2, 1, 0.1}, vec3(10.0f));
  builder.camera({0.1, -0.8, 0.2}, {0, 0, 0}, 1.4, kSize, kSize);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Rendered r = renderScene(makeJob(integrator, 4), builder.finish());
    EXPECT_EQ(r.stats.global.hits > 0, integrator == Integrator::photon);
    for (const float value : valuesOf(r.image)) ASSERT_EQ(value, 0.0f);
  }
  listed.note("0 in every pixel", 1);
}

TEST_F(ClosedForms, NoPhotonIsKeptWhereNothingIsSeen) {
  StabilityCase listed(25, "the camera sees only sky", "no photons kept");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.environment(vec3(0.25f));
  builder.camera({0, 1, 0}, {0, 3, 0.1}, 0.8, kSize, kSize);
  const Rendered r = renderScene(makeJob(Integrator::photon, 2), builder.finish());
  EXPECT_EQ(r.stats.global.stored + r.stats.caustic.stored, 0u);
  EXPECT_TRUE(isConstant(r.image, 0.25, 0));
  listed.note("none", 1);
}

}  // namespace
}  // namespace importon::test::closed_form_test
