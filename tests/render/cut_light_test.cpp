// Emitters that alpha cuts away, wholly or in part: what is not there emits nothing.
#include "render_helper.h"
#include "scene/lights.h"

namespace importon::test::cut_light_test {
namespace {

constexpr int kSize = 8;

class CutLights : public RenderTest {};

/// A lamp that shines on a wall alone, which lights the floor that the camera sees; its UVs run over the unit square.
template <class AddLamp>
Scene wallBeforeLamp(AddLamp addLamp) {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.8f)));
  builder.square(white, {0, 0, 0}, {0, 1, 0}, 12);
  builder.square(white, {0, 2, -2}, {0, 0, 1}, 8);
  builder.square(builder.material(diffuse(vec3(0.0f))), {0, 2.5, -1.199}, {0, 0, -1}, 2);  // takes what passes the lamp
  addLamp(builder);
  builder.camera({0, 2, 2}, {0, 0, 0}, 0.5, kSize, kSize);
  return builder.finish();
}

/// 2 m wide.
Scene wholeLamp(const Material& material) {
  return wallBeforeLamp([&](SceneBuilder& builder) {
    builder.quad(builder.material(material), {1, 1.5, -1.2}, {-2, 0, 0}, {0, 2, 0});
  });
}

/// The half of it where u is less than 0.5.
Scene halfLamp() {
  return wallBeforeLamp([](SceneBuilder& builder) {
    builder.quad(builder.material(emitter(vec3(5.0f))), {1, 1.5, -1.2}, {-1, 0, 0}, {0, 2, 0});
  });
}

/// A lamp of which a texture leaves the left texel; lights are made anew, as the loader makes them.
Scene cutLamp(uint alphaMode) {
  Material material = emitter(vec3(5.0f));
  material.flags |= alphaMode;
  material.alphaCutoff = 0.5f;
  Scene scene = wholeLamp(material);
  Texture texture{};
  texture.width = 2;
  texture.height = 1;
  texture.isNearest = 1;
  texture.uvRow0 = vec3(1, 0, 0);
  texture.uvRow1 = vec3(0, 1, 0);
  scene.texels = {0xFFFFFFFFu, 0x00FFFFFFu};
  scene.textures = {texture};
  for (Material& m : scene.materials)
    if ((m.flags & kMaterialEmissive) != 0) m.baseColorTexture = 0;
  scene.lights.clear();
  scene.lightOfTriangle.clear();
  addEmissiveTriangles(scene);
  return scene;
}

RenderJob jobOf(Integrator integrator) {
  RenderJob job = makeJob(integrator, integrator == Integrator::path ? 1 : 2);
  job.gather = integrator == Integrator::path ? 2048 : 512;
  job.photons = 1u << 14;
  return job;
}

/// Two one-sided tests at a significance of 0.01, power above 0.9.
::testing::AssertionResult shineAlike(const Scene& cut, const Scene& like, Integrator integrator) {
  constexpr int kSeeds = 8;
  return areWithin(0.02, meanOverSeeds(jobOf(integrator), cut, kSeeds), meanOverSeeds(jobOf(integrator), like, kSeeds));
}

TEST_F(CutLights, WhatIsCutAwayEmitsNothing) {
  EXPECT_TRUE(shineAlike(cutLamp(kMaterialAlphaMask), halfLamp(), Integrator::photon));
}

TEST_F(CutLights, BlendedOnesEmitByTheirAlpha) {
  Material blended = emitter(vec3(5.0f));
  blended.flags |= kMaterialAlphaBlend;
  blended.baseColor.w = 0.5f;
  EXPECT_TRUE(shineAlike(wholeLamp(blended), wholeLamp(emitter(vec3(2.5f))), Integrator::path));
}

TEST_F(CutLights, PowersKnowWhatIsCutAway) {
  const auto powerOf = [](const Scene& scene) {
    double sum = 0;
    for (const Light& light : scene.lights) sum += light.power;
    return sum;
  };
  EXPECT_NEAR(powerOf(cutLamp(kMaterialAlphaMask)) / powerOf(halfLamp()), 1, 0.02);
  EXPECT_NEAR(powerOf(cutLamp(kMaterialAlphaBlend)) / powerOf(halfLamp()), 1, 0.02);
}

}  // namespace
}  // namespace importon::test::cut_light_test
