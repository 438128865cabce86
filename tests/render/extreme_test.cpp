// Scenes and jobs at the edge of what makes sense.
#include <algorithm>
#include <cmath>

#include "render_helper.h"

namespace importon::test::extreme_test {
namespace {

constexpr int kSize = 16;

class Extreme : public RenderTest {};

/// A lit floor that the camera sees from above.
SceneBuilder litFloor(int size = kSize) {
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 4);
  builder.square(builder.material(diffuse(vec3(0.5f))), {-1, 1, 0}, {1, 0, 0}, 2);
  builder.square(builder.material(emitter(vec3(2.0f))), {0, 2, 0}, {0, -1, 0}, 1);
  builder.camera({0, 1.5, 1.5}, {0, 0, 0}, 0.8, size, size);
  return builder;
}

TEST_F(Extreme, FewPhotonsGiveFiniteImages) {
  const StabilityCase listed(40, "0 to 3 photons in a map", "finite");
  const Scene scene = litFloor().finish();
  for (const std::uint32_t photons : {1u, 2u, 3u}) {
    for (const DensityControl control : {DensityControl::off, DensityControl::density}) {
      RenderJob job = makeJob(Integrator::photon, 2);
      job.photons = photons;
      job.control = control;
      const Rendered r = renderScene(job, scene);
      EXPECT_TRUE(isSane(r.image)) << photons;
      EXPECT_GT(meanOf(r.image), 0);  // direct light
      EXPECT_EQ(r.stats.photonsEmitted, 2 * photons);
      EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits);
    }
  }
}

TEST_F(Extreme, OnePixelIsTheMeanOfMany) {
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    RenderJob job = makeJob(integrator, 4);
    job.gather = 64;
    const Moments many = meanOverSeeds(job, litFloor().finish(), 8);
    job.gather = 4096;
    const Moments one = meanOverSeeds(job, litFloor(1).finish(), 8);
    EXPECT_TRUE(areWithin(0.02, one, many));
  }
}

TEST_F(Extreme, OnePassSeesTheSky) {
  StabilityCase listed(25, "the camera sees only sky", "right image, no importons");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.environment(vec3(0.25f, 0.5f, 0.75f));
  builder.camera({0, 1, 0}, {0, 3, 0.1}, 0.8, kSize, kSize);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Rendered r = renderScene(makeJob(integrator, 1), builder.finish());
    EXPECT_EQ(std::ranges::minmax(valuesOf(r.image, "B")).min, 0.75f);
    EXPECT_EQ(std::ranges::minmax(valuesOf(r.image, "B")).max, 0.75f);
    EXPECT_EQ(r.stats.importonsGlobal + r.stats.importonsCaustic, 0u);
  }
  listed.note("exact", 1);
}

/// Case 41: a camera that stands exactly on a floor, or on a wall of glass.
TEST_F(Extreme, CameraOnASurfaceGivesAFiniteImage) {
  const StabilityCase listed(41, "camera on a surface", "finite");
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    SceneBuilder onFloor;
    onFloor.square(onFloor.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 4);
    onFloor.square(onFloor.material(emitter(vec3(2.0f))), {0, 2, 0}, {0, -1, 0}, 1);
    onFloor.camera({0, 0, 0}, {0, 1, 0.01}, 2.0, kSize, kSize);
    EXPECT_TRUE(isSane(renderScene(makeJob(integrator, 1), onFloor.finish()).image));
    SceneBuilder onGlass = litFloor();
    onGlass.box(onGlass.material(glass(1.5f)), {-0.5, 1, 1.5}, {0.5, 2, 2},
                Facing::outside);  // its front meets the camera
    EXPECT_TRUE(isSane(renderScene(makeJob(integrator, 1), onGlass.finish()).image));
  }
}

TEST_F(Extreme, EmitterThatFillsTheViewIsItsRadiance) {
  StabilityCase listed(25, "the camera sees only an emitter", "its radiance");
  SceneBuilder builder = litFloor();
  builder.square(builder.material(emitter(vec3(7.0f))), {0, 1.2, 1.2}, {0, 1, 1}, 2);
  for (const Integrator integrator : {Integrator::path, Integrator::photon})
    EXPECT_TRUE(isConstant(renderScene(makeJob(integrator, 2), builder.finish()).image, 7, 0));
  listed.note("exact", 1);
}

TEST_F(Extreme, ScenesWithoutLightsAreBlack) {
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 2);
  builder.camera({0, 1, 1}, {0, 0, 0}, 0.8, kSize, kSize);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Image image = renderScene(makeJob(integrator, 1), builder.finish()).image;
    for (const float value : valuesOf(image)) ASSERT_EQ(value, 0.0f);
  }
}

/// A bright speck, smaller than a pixel, before black: its light is the same in all, however it is spread.
TEST_F(Extreme, FiltersSpreadLightButKeepIt) {
  SceneBuilder builder;
  builder.square(builder.material(emitter(vec3(100.0f))), {0.02, 0.03, 0}, {0, 0, 1}, 0.036);
  builder.camera({0, 0, 2}, {0, 0, 0}, 0.8, kSize, kSize);
  const Scene scene = builder.finish();
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 2048;  // paths per pixel
  const auto figures = [&](PixelFilter filter) {
    job.filter = filter;
    return overSeeds(job, scene, 8, [](const Rendered& r) {
      const std::vector<float> values = valuesOf(r.image);
      const auto lit = std::ranges::count_if(values, [](float value) { return value > 0; });
      return std::vector{meanOf(r.image), static_cast<double>(lit)};
    });
  };
  const std::vector<Moments> box = figures(PixelFilter::box);
  for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::blackmanHarris}) {
    const std::vector<Moments> other = figures(filter);
    EXPECT_TRUE(areWithin(0.05, other[0], box[0]));
    EXPECT_GT(other[1].mean(), box[1].mean());
  }
}

/// All photons of a narrow beam fall in one place.
TEST_F(Extreme, BeamKeepsItsPower) {
  const StabilityCase listed(19, "a collimated beam", "power exact");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 4);
  builder.square(builder.material(diffuse(vec3(0.5f))), {0, 1.5, 0}, {0, -1, 0}, 4);
  builder.spotLight({0, 1, 0}, {0, -1, 0}, vec3(1e6f), 0.0, 0.001);
  builder.camera({0, 1.2, 1.5}, {0, 0, 0}, 0.8, kSize, kSize);
  for (const DensityControl control : {DensityControl::off, DensityControl::density}) {
    RenderJob job = makeJob(Integrator::photon, 1);
    job.control = control;
    const Rendered r = renderScene(job, builder.finish());
    EXPECT_GE(r.stats.global.stored, 1u);
    EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits);
    EXPECT_TRUE(isSane(r.image));
  }
}

/// Two rooms of inner faces, 1e-5 of the scene apart; the light is in one, the camera in the other, dark one,
/// which is lower and narrower.
Scene roomsApart() {
  SceneBuilder builder;
  const uint walls = builder.material(diffuse(vec3(0.8f)));
  builder.box(walls, {-1, -1, -1}, {0, 1, 1}, Facing::inside);
  builder.box(walls, {2e-5, -0.8, -0.8}, {1, 0.8, 0.8}, Facing::inside);
  builder.pointLight({-0.2, 0.1, 0}, vec3(10.0f));
  builder.camera({0.8, 0, 0.5}, {0, -0.5, 0}, 1.4, kSize, kSize);
  return builder.finish();
}

TEST_F(Extreme, ThinWallKeepsLightOut) {
  StabilityCase listed(13, "a wall 1e-5 of the scene thick", "the dark side exactly 0");
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Rendered r = renderScene(makeJob(integrator, 4), roomsApart());
    EXPECT_EQ(r.stats.global.hits > 0, integrator == Integrator::photon);
    for (const float value : valuesOf(r.image)) ASSERT_EQ(value, 0.0f);
  }
  listed.note("0 in every pixel", 1);
}

/// A floor in light that grazes it.
TEST_F(Extreme, GrazingCausticLightKeepsItsMean) {
  const StabilityCase listed(20, "caustic light at 88.9 degrees", "its mean");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 4);
  builder.box(builder.material(glass(1.0f)), {-3, -1, -3}, {3, 1, 3}, Facing::outside);
  constexpr double kCosine = 0.02;  // of 88.9 degrees
  builder.directionalLight({std::sqrt(1 - kCosine * kCosine), -kCosine, 0}, vec3(100.0f));
  builder.camera({0, 0.8, 0}, {0, 0, 0}, 0.8, kSize, kSize, {0, 0, 1});
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 18;
  EXPECT_TRUE(isWithin(0.1, meanOverSeeds(job, builder.finish(), 8), 100 * kCosine / 3.14159265358979));
}

}  // namespace
}  // namespace importon::test::extreme_test
