// Photons of a light together carry its power, as the scene states it.
#include <gtest/gtest.h>

#include <functional>

#include "method/map_rig.h"
#include "scene/lights.h"
#include "support/gpu_test.h"
#include "support/profile_lamp.h"
#include "support/scene_builder.h"

namespace importon::emitted_power_test {
namespace {

using test::SceneBuilder;

constexpr std::uint32_t kPhotons = 1u << 14;

class EmittedPower : public test::GpuTest {
 protected:
  /// Of the photons of the scene's lights over the lights' own.
  double ratio(const std::function<void(SceneBuilder&)>& addLights) {
    SceneBuilder builder;
    builder.box(builder.material(test::diffuse(vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
    addLights(builder);
    builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 16, 16);
    return ratio(builder.finish());
  }

  double ratio(const Scene& scene) {
    RenderJob job;
    job.photons = job.photonBatch = kPhotons;
    job.importons = 1u << 10;
    test::MapRig rig(context(), scene, job);
    double power = 0, carried = 0;
    for (const Light& light : scene.lights) power += static_cast<double>(light.power);
    for (const test::EmittedPhoton& photon : rig.emit(MapKind::global)) carried += static_cast<double>(photon.flux.y);
    return carried / power;
  }
};

// Two triangles of equal power are chosen by points of a sequence that fills them evenly.
TEST_F(EmittedPower, OfASquareIsThatOfItsSides) {
  for (const bool hasTwoSides : {false, true}) {
    const double carried = ratio([&](SceneBuilder& builder) {
      builder.square(builder.material(test::emitter(vec3(5), hasTwoSides)), {0.1, 0.3, 0}, {0, -1, 0}, 0.4);
    });
    EXPECT_NEAR(carried, 1, 1e-3) << (hasTwoSides ? "two sides" : "one side");
  }
}

TEST_F(EmittedPower, OfParallelAndOfPointLightIsTheSameInEveryPhoton) {
  EXPECT_NEAR(ratio([](SceneBuilder& builder) { builder.directionalLight({0.3, -1, 0.2}, vec3(2)); }), 1, 1e-4);
  EXPECT_NEAR(ratio([](SceneBuilder& builder) { builder.pointLight({0.3, 0.1, 0.2}, vec3(2)); }), 1, 1e-4);
}

// The falloff over the cone is integrated by 2^14 points that fill it evenly.
TEST_F(EmittedPower, OfASpotIsTheIntegralOverItsCone) {
  EXPECT_NEAR(ratio([](SceneBuilder& builder) {
                builder.spotLight({0, 0.5, 0}, {0.2, -1, 0}, vec3(2), 0.2, 0.9);
              }),
              1, 2e-3);
}

TEST_F(EmittedPower, OfALampWithAProfileIsTheIntegralOverIt) {
  const LightProfile profile = sampleProfile(IesProfile(Photometry::typeC, {0, 30, 120}, {0, 90}, {5, 8, 0, 5, 2, 0}));
  SceneBuilder builder;
  builder.box(builder.material(test::diffuse(vec3(0.5f))), {-1, -1, -1}, {1, 1, 1}, test::Facing::inside);
  builder.pointLight({0.1, 0.5, 0}, vec3(1));
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 16, 16);
  Scene scene = builder.finish();
  test::shineByProfile(scene, profile, vec3(0, -1, 0));
  EXPECT_NEAR(ratio(scene), 1, 4e-3);
}

TEST_F(EmittedPower, OfAnEnvironmentIsThatOfTheDiscAroundTheScene) {
  EXPECT_NEAR(ratio([](SceneBuilder& builder) { builder.environment(vec3(2)); }), 1, 2e-3);
}

}  // namespace
}  // namespace importon::emitted_power_test
