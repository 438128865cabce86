// Materials at their limits: smooth against rough, and shading normals far from the surface's own.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::material_test {
namespace {

constexpr int kSize = 8;

class Materials : public RenderTest {};

RenderJob jobOf(int paths, Integrator integrator = Integrator::path) {
  RenderJob job = makeJob(integrator, 1);
  job.gather = paths;  // per pixel
  return job;
}

/// A plate that shows an emitter of radiance 1, much larger than the lobe of a nearly smooth one.
Scene plateBeforeLight(const Material& material) {
  SceneBuilder builder;
  builder.square(builder.material(material), {0, 0, 0}, {0, 0, 1}, 2);
  builder.square(builder.material(emitter(vec3(1.0f))), {0, 0, 4}, {0, 0, -1}, 60);
  builder.camera({0, 0, 3}, {0, 0, 0}, 0.1, kSize, kSize);
  return builder.finish();
}

/// Case 43. Reflectance 0.8 at normal incidence, whether a mirror or just not one any more; the table of
/// directional albedo is true to 0.004.
TEST_F(Materials, BrightnessDoesNotJumpWhereMirrorTurnsGlossy) {
  StabilityCase listed(43, "where mirror turns to glossy", "no jump");
  for (const float roughness : {0.0f, 0.03f, 0.033f, 0.06f}) {
    const Moments values =
        momentsOf(valuesOf(renderScene(jobOf(16), plateBeforeLight(metal(vec3(0.8f), roughness))).image));
    EXPECT_NEAR(values.mean(), 0.8, 0.004 + 4 * values.standardError()) << roughness;
  }
  listed.note("none", 1);
}

/// The rest of case 43: a white plate in uniform light is white at every roughness.
TEST_F(Materials, WhiteMetalStaysWhiteFromMirrorToRough) {
  const StabilityCase listed(43, "white metal, roughness 0 to 1", "white");
  for (const float roughness : {0.0f, 0.2f, 0.6f, 1.0f}) {
    SceneBuilder builder;
    builder.square(builder.material(metal(vec3(1.0f), roughness)), {0, 0, 0}, {0, 0, 1}, 8);
    builder.environment(vec3(1.0f));
    builder.camera({0, 2, 3}, {0, 0, 0}, 0.5, kSize, kSize);
    const Moments values = momentsOf(valuesOf(renderScene(jobOf(64), builder.finish()).image));
    EXPECT_NEAR(values.mean(), 1, 0.004 + 4 * values.standardError()) << roughness;
  }
}

TEST_F(Materials, ClearCoatReflectsFourPercent) {
  Material coated = diffuse(vec3(0.0f));  // black below
  coated.clearcoat = 1;
  // Nothing but the coat reflects: no noise. At 3 degrees it is as at none, to the fifth power of 0.0013.
  EXPECT_TRUE(isConstant(renderScene(jobOf(4), plateBeforeLight(coated)).image, 0.04, 1e-5));
}

/// KHR_materials_unlit: the colour that it has, whatever the light, and none of it for others.
TEST_F(Materials, UnlitOnesShowTheirColorAndLightNothing) {
  Material unlit = diffuse(vec3(0.3f));
  unlit.flags |= kMaterialUnlit;
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    EXPECT_TRUE(isConstant(renderScene(jobOf(4, integrator), plateBeforeLight(unlit)).image, 0.3, 1e-6));
    SceneBuilder builder;
    builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 0, 1}, 2);
    builder.square(builder.material(unlit), {0, 0, 4}, {0, 0, -1}, 60);
    builder.pointLight({0, 0, 5}, vec3(1));  // behind it
    builder.camera({0, 0, 3}, {0, 0, 0}, 0.1, kSize, kSize);
    EXPECT_TRUE(isConstant(renderScene(jobOf(4, integrator), builder.finish()).image, 0, 0));
  }
}

/// A texel of 188 is 0.737 of the greatest value, which sRGB takes for 0.503. [IEC 61966-2-1]
TEST_F(Materials, TexturesInSrgbAreDecoded) {
  for (const bool isSrgb : {true, false}) {
    Scene scene = [] {
      Material unlit = diffuse(vec3(1.0f));
      unlit.flags |= kMaterialUnlit;
      return plateBeforeLight(unlit);
    }();
    Texture texture{};
    texture.width = texture.height = 1;
    texture.isSrgb = isSrgb ? 1 : 0;
    texture.uvRow0 = vec3(1, 0, 0);
    texture.uvRow1 = vec3(0, 1, 0);
    scene.texels = {0xFFBCBCBCu};
    scene.textures = {texture};
    scene.materials[0].baseColorTexture = 0;
    const double value = 188.0 / 255, linear = std::pow((value + 0.055) / 1.055, 2.4);
    EXPECT_TRUE(isConstant(renderScene(jobOf(1), scene).image, isSrgb ? linear : value, 1e-5));
  }
}

/// 16 bits of each channel: eight would be off by up to 0.002.
TEST_F(Materials, TexturesOfSixteenBitsKeepThem) {
  Material unlit = diffuse(vec3(1.0f));
  unlit.flags |= kMaterialUnlit;
  Scene scene = plateBeforeLight(unlit);
  Texture texture{};
  texture.firstTexel = 1;
  texture.width = 1;
  texture.height = 2;
  texture.isDeep = 1;
  texture.uvRow0 = vec3(1, 0, 0);
  texture.uvRow1 = vec3(0, 1, 0);
  const uint value = 0x4142u, pair = value << 16 | value;
  scene.texels = {0, pair, 0xFFFF0000u | value, pair, 0xFFFF0000u | value};
  scene.textures = {texture};
  scene.materials[0].baseColorTexture = 0;
  EXPECT_TRUE(isConstant(renderScene(jobOf(1), scene).image, value / 65535.0, 1e-6));
}

/// Of a rough plate near a light, each technique finds a good part of the light; the weights know the number of lights.
TEST_F(Materials, ALightCutIntoManyShinesAsOne) {
  const auto shine = [](int cells) {
    SceneBuilder builder;
    builder.square(builder.material(metal(vec3(0.9f), 0.4f)), {0, 0, 0}, {0, 0, 1}, 2);
    builder.square(builder.material(emitter(vec3(1.0f))), {0, 0.5, 0.6}, {0, -0.3, -1}, 1, cells);
    builder.camera({0, -1.5, 1}, {0, 0, 0}, 0.3, kSize, kSize);
    const std::vector<float> values = valuesOf(renderScene(jobOf(512), builder.finish()).image);
    return std::vector<double>(values.begin(), values.end());
  };
  const std::vector<double> one = shine(1);
  for (const int cells : {4, 8})
    EXPECT_TRUE(isWithin(0.01, ratiosOf(shine(cells), one), 1)) << 2 * cells * cells << " triangles";
}

/// Case 44: an icosahedron with the normals of a sphere, up to 37 degrees off.
SceneBuilder icosahedron(const Material& material, Facing facing) {
  SceneBuilder builder;
  builder.icosphere(builder.material(material), {0, 0, 0}, 1, 0, facing, Shading::smooth);
  return builder;
}

TEST_F(Materials, ShadingNormalsLetNoLightThroughTheBack) {
  StabilityCase listed(44, "shading normals far off", "no light through the back");
  // Both inside: one behind all shading normals; one at a corner, towards which shading normals around it lean.
  for (const glm::dvec3& light :
       {glm::dvec3(0.1, 0.2, 0), 0.95 * glm::normalize(glm::dvec3(0, 1, glm::golden_ratio<double>()))})
    for (const Facing facing : {Facing::outside, Facing::inside}) {
      SceneBuilder builder = icosahedron(diffuse(vec3(0.9f)), facing);
      builder.square(builder.material(diffuse(vec3(0.9f))), {0, -1.2, 0}, {0, 1, 0}, 8);
      builder.pointLight(light, vec3(10.0f));
      builder.camera({0, 1, 4}, {0, -0.5, 0}, 0.8, kSize, kSize);
      for (const Integrator integrator : {Integrator::path, Integrator::photon})
        for (const float value : valuesOf(renderScene(jobOf(16, integrator), builder.finish()).image))
          ASSERT_EQ(value, 0.0f);
    }
  listed.note("0", 1);
}

TEST_F(Materials, ShadingNormalsGainNoEnergy) {
  StabilityCase listed(44, "shading normals far off", "no energy gained");
  for (const Material& white : {diffuse(vec3(1.0f)), metal(vec3(1.0f), 0.3f), mirror()}) {
    SceneBuilder builder = icosahedron(white, Facing::outside);
    builder.environment(vec3(1.0f));
    builder.camera({0, 0.5, 3}, {0, 0, 0}, 0.8, kSize, kSize);
    const Moments values = momentsOf(valuesOf(renderScene(jobOf(64), builder.finish()).image));
    EXPECT_LE(values.mean(), 1.004 + 4 * values.standardError());
    EXPECT_GT(values.mean(), 0.8);  // and little is lost
  }
  listed.note("none", 1);
}

/// A white mirror shows a uniform environment as it is, also where its normals would mirror rays into its facets.
TEST_F(Materials, CoarseMirrorsHaveNoBlackRims) {
  const StabilityCase listed(44, "shading normals far off", "no black rims on mirrors");
  for (const int rings : {4, 6}) {
    SceneBuilder builder;
    builder.uvSphere(builder.material(mirror()), {0, 0, 0}, 1, rings, 2 * rings, Facing::outside, Shading::smooth);
    builder.environment(vec3(1.0f));
    builder.camera({0, 0.5, 3}, {0, 0, 0}, 0.8, 4 * kSize, 4 * kSize);
    for (const Integrator integrator : {Integrator::path, Integrator::photon})
      EXPECT_TRUE(isConstant(renderScene(jobOf(16, integrator), builder.finish()).image, 1, 1e-4));
  }
}

/// A smooth sphere of few facets in the sun, from the side: every pixel is as bright as its own normals say.
TEST_F(Materials, TheTerminatorOfSmoothNormalsShowsNoFacets) {
  const StabilityCase listed(44, "shading normals far off", "a soft terminator");
  SceneBuilder builder;
  builder.uvSphere(builder.material(diffuse(vec3(0.8f))), {0, 0, 0}, 1, 6, 12, Facing::outside, Shading::smooth);
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 0.2, 0.3));
  builder.directionalLight(-towards, vec3(glm::pi<float>()));
  builder.camera({0, 0.5, 3}, {0, 0, 0}, 0.5, 4 * kSize, 4 * kSize);
  const glm::dvec3 towardsCamera = glm::normalize(glm::dvec3(0, 0.5, 3));
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    RenderJob job = jobOf(16, integrator);
    job.aovs = {"N"};
    const Image image = renderScene(job, builder.finish()).image;
    const std::vector<float> nx = valuesOf(image, "N.X"), ny = valuesOf(image, "N.Y"), nz = valuesOf(image, "N.Z");
    const std::vector<float> values = valuesOf(image);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const glm::dvec3 normal(nx[i], ny[i], nz[i]);
      if (glm::dot(normal, towardsCamera) < 0.5) continue;  // beside the sphere, or near its outline
      EXPECT_NEAR(values[i], 0.8 * std::max(glm::dot(normal, towards), 0.0), 0.03) << i;
    }
  }
}

}  // namespace
}  // namespace importon::test::material_test
