// Smooth thin surfaces: light of lamps, sun and sky goes straight through them, found by shadow rays as without them.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::pane_test {
namespace {

constexpr int kSize = 16;

class Pane : public RenderTest, public ::testing::WithParamInterface<Integrator> {
 protected:
  [[nodiscard]] static Moments renderMean(const Scene& scene, int paths, int seeds, const char* channel = "R") {
    RenderJob job = makeJob(GetParam(), 1);
    job.gather = paths;
    job.photons = 1u << 14;
    return overSeeds(job, scene, seeds, [&](const Rendered& r) { return std::vector{meanOf(r.image, channel)}; })
        .front();
  }
};

/// (1 - R) / (1 + R) with R = ((n - 1) / (n + 1))²: of a sheet at normal incidence, all inner reflections counted.
double sheetTransmittance(double ior) {
  const double reflectance = (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1));
  return (1 - reflectance) / (1 + reflectance);
}

/// Black but for what a lamp sends straight to the floor: it, and the panes between, are all there is.
SceneBuilder floorBelow(const std::vector<Material>& panes) {
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  double height = 1;
  for (const Material& pane : panes) builder.square(builder.material(pane), {0, height += 0.01, 0}, {0, 1, 0}, 40);
  builder.camera({0.3, 0.8, 0}, {0, 0, 0}, 0.3, kSize, kSize, {0, 0, 1});
  return builder;
}

Material tintedPane(const vec3& tint, float ior = 1.0f) {
  Material pane = thinGlass(ior);
  pane.baseColor = vec4(tint, 1);
  return pane;
}

TEST_P(Pane, LetsTheSunThroughByItsFresnelAndItsTint) {
  for (const std::size_t count : {1u, 4u}) {
    SceneBuilder builder = floorBelow(std::vector(count, tintedPane(vec3(0.5f, 0.9f, 1.0f))));
    builder.directionalLight({0, -1, 0}, vec3(glm::pi<float>()));
    const Scene scene = builder.finish();
    const double once[] = {0.5, static_cast<double>(0.9f), 1.0};
    for (int c = 0; c < 3; ++c) {
      const Moments light = renderMean(scene, 16, 3, std::array{"R", "G", "B"}[static_cast<std::size_t>(c)]);
      EXPECT_TRUE(isWithin(1e-4, light, 0.5 * std::pow(once[c], static_cast<double>(count)))) << count << ' ' << c;
    }
  }
}

TEST_P(Pane, DimsPointLightsAsItDimsWhatIsSeenThroughIt) {
  SceneBuilder builder = floorBelow({thinGlass(1.5f)});
  builder.directionalLight({0, -1, 0}, vec3(glm::pi<float>()));
  // The floor sends half of the light up; the pane turns a share of it back, from where it lights the floor again.
  RenderJob job = makeJob(GetParam(), 1);
  job.gather = 16;
  job.aovs = {"direct"};
  const auto direct = [](const Rendered& r) { return std::vector{meanOf(r.image, "direct.R")}; };
  EXPECT_TRUE(isWithin(1e-3, overSeeds(job, builder.finish(), 3, direct).front(), 0.5 * sheetTransmittance(1.5)));
}

/// Shadow rays and scattered ones share out what both find: here lamps so near and large that both matter, and so many
/// that their choice from the pane would differ from that from the floor.
TEST_P(Pane, OfIndexOneOnlyTintsWhatLampsBring) {
  Moments found[2];
  for (const bool hasPane : {false, true}) {
    SceneBuilder builder = floorBelow(hasPane ? std::vector{tintedPane(vec3(0.6f))} : std::vector<Material>{});
    builder.square(builder.material(emitter(vec3(hasPane ? 1.0f : 0.6f))), {0, 1.4, 0}, {0, -1, 0}, 3, 3);
    found[hasPane ? 1 : 0] = renderMean(builder.finish(), 256, 8);
  }
  EXPECT_TRUE(isWithin(0.005, found[1], found[0].mean()));
}

/// All is white and sees a white sky: whatever the pane passes and turns back adds up.
TEST_P(Pane, UnderAUniformSkyChangesNothing) {
  SceneBuilder builder;
  builder.environment(vec3(1.0f));
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 30);
  builder.square(builder.material(thinGlass(1.5f)), {0, 1, 0}, {0.3, 1, 0.1}, 3);
  builder.camera({0, 0.5, 2.5}, {0, 0, 0}, 0.4, kSize, kSize);
  EXPECT_TRUE(isWithin(0.005, renderMean(builder.finish(), 128, 24), 1.0));
}

/// A pane of which three quarters scatter light diffusely.
TEST_P(Pane, ThatScattersTooPassesTheRest) {
  SceneBuilder builder;
  Material half = tintedPane(vec3(1.0f));
  half.transmission = 0.25f;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.square(builder.material(half), {0, 1, 0}, {0, 1, 0}, 40);
  builder.directionalLight({0, -1, 0}, vec3(glm::pi<float>()));
  builder.camera({0.3, 0.8, 0}, {0, 0, 0}, 0.3, kSize, kSize, {0, 0, 1});
  RenderJob job = makeJob(GetParam(), 1);
  job.gather = 16;
  job.aovs = {"direct"};
  const auto direct = [](const Rendered& r) { return std::vector{meanOf(r.image, "direct.R")}; };
  EXPECT_TRUE(isWithin(1e-3, overSeeds(job, builder.finish(), 3, direct).front(), 0.5 * 0.25));
}

INSTANTIATE_TEST_SUITE_P(Both, Pane, ::testing::Values(Integrator::path, Integrator::photon),
                         [](const auto& test) { return test.param == Integrator::path ? "Path" : "Photon"; });

}  // namespace
}  // namespace importon::test::pane_test
