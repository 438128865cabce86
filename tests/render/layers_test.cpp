// Layers of materials in whole images: the photon map against the path tracer, and images that are known.
#include <optional>
#include <ostream>
#include <string>

#include "render_helper.h"
#include "scene/packing.h"

namespace importon::test::layers_test {
namespace {

constexpr int kSize = 8;

class Layers : public RenderTest {};

struct Layered {
  std::string name;
  void (*build)(SceneBuilder&);
  int paths;                           // per pixel, of the path tracer
  int gather;                          // rays per pixel and pass of the photon map's image
  int log2Photons;                     // per pass
  bool hasPhotons = true;              // gather rays read photons, too
  bool hasTangents = false;            // along x
  std::optional<double> density = {};  // of the map of photons, 1/m²: where surfaces bend, lookups must be narrow
};

std::ostream& operator<<(std::ostream& stream, const Layered& c) { return stream << c.name; }

Material leaf() {
  Material material = diffuse(vec3(0.2f, 0.5f, 0.2f));
  material.specular = 1;
  material.roughness = 0.6f;
  material.diffuseTransmission = 0.6f;
  material.diffuseTransmissionColor = vec3(0.9f, 0.8f, 0.3f);
  return material;
}

uint white(SceneBuilder& builder) { return builder.material(diffuse(vec3(0.8f))); }

void addLight(SceneBuilder& builder, const glm::dvec3& center, const glm::dvec3& normal, double side) {
  builder.square(builder.material(emitter(vec3(5.0f))), center, normal, side);
}

/// A leaf lit from behind, which lights the floor that the camera sees.
void buildLeafLightsFloor(SceneBuilder& builder) {
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 4);
  builder.square(builder.material(leaf()), {0, 1.5, 0}, {0, 1, 0}, 3);
  addLight(builder, {0.3, 2.5, 0}, {0, -1, 0}, 2);
  builder.camera({0, 1.2, 0.4}, {0, 0, 0}, 1.3, kSize, kSize, {0, 0, 1});
}

/// Light that a white wall reflects reaches the camera through a leaf, and from its front.
void buildLightBehindLeaf(SceneBuilder& builder) {
  const uint wall = white(builder);
  builder.square(wall, {0, 0, -1.2}, {0, 0, 1}, 4);
  builder.square(wall, {0, -1.5, 0.5}, {0, 1, 0.3}, 4);
  builder.square(builder.material(leaf()), {0, 0, 0}, {0, 0, -1}, 2);
  addLight(builder, {0, 1.2, -0.5}, {0, 0.2, -1}, 1);
  addLight(builder, {0, 1.2, 0.8}, {0, -1, -0.1}, 0.7);
  builder.camera({0, 0.1, 3}, {0, 0, 0}, 0.5, kSize, kSize);
}

/// A ball of translucent wax that absorbs, and clear beside.
void buildWaxBall(SceneBuilder& builder) {
  Material wax = leaf();
  wax.flags |= kMaterialSolid;
  wax.absorption = vec3(0.5f, 1, 2);
  wax.diffuseTransmission = 1;
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 6);
  builder.icosphere(builder.material(wax), {0, 0.8, 0}, 0.7, 2, Facing::outside, Shading::smooth);
  addLight(builder, {0.3, 2.5, -0.4}, {0, -1, 0}, 2);
  builder.camera({0, 1, 4}, {0, 0.4, 0}, 0.4, kSize, kSize);
}

/// Plates of a material, seen and lit by each other, and by what they throw on the floor.
void addPlates(SceneBuilder& builder, const Material& material) {
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 6);
  builder.square(builder.material(material), {0, 1.5, -2}, {0, -0.2, 1}, 4);
  addLight(builder, {0, 2.5, -0.6}, {0, -0.3, -1}, 2);
  builder.camera({0, 1.2, 3}, {0, 0.3, 0}, 0.9, kSize, kSize);
}

void buildSheen(SceneBuilder& builder) {
  Material cloth = diffuse(vec3(0.6f, 0.2f, 0.2f));
  cloth.specular = 1;
  cloth.sheenColor = vec3(0.8f, 0.9f, 1);
  cloth.sheenRoughness = 0.5f;
  addPlates(builder, cloth);
}

void buildAnisotropy(SceneBuilder& builder) {
  Material brushed = metal(vec3(0.9f), 0.5f);
  brushed.anisotropy = 0.7f;
  brushed.anisotropyRotation = 0.5f;
  addPlates(builder, brushed);
}

void buildIridescence(SceneBuilder& builder) {
  Material shell = metal(vec3(0.4f), 0.5f);
  shell.metallic = 0.5f;
  shell.iridescence = 1;
  addPlates(builder, shell);
}

Material flint() {
  Material material = glass(1.7f);
  material.dispersion = 5;
  return material;
}

/// A bubble of coloured glass of one surface over a floor, which its shadow colours; smooth or rough.
void addBubble(SceneBuilder& builder, float roughness, float diffuseShare) {
  Material sheet = glass(1.5f, vec3(4, 1, 8));
  sheet.flags = kMaterialDoubleSided;
  sheet.thickness = 0.2f;
  sheet.roughness = roughness;
  sheet.transmission = 1 - diffuseShare;
  sheet.diffuseTransmission = diffuseShare;
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 6);
  builder.uvSphere(builder.material(sheet), {0, 1, 0}, 0.7, 8, 12, Facing::outside, Shading::flat);
  addLight(builder, {0.3, 2.5, -0.4}, {0, -1, 0}, 2);
  builder.camera({0, 1, 4}, {0, 0.4, 0}, 0.4, kSize, kSize);
}
void buildSmoothBubble(SceneBuilder& builder) { addBubble(builder, 0, 0); }
void buildRoughBubble(SceneBuilder& builder) { addBubble(builder, 0.4f, 0); }
void buildPaperBubble(SceneBuilder& builder) { addBubble(builder, 0.6f, 0.8f); }

void buildDispersion(SceneBuilder& builder) {
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 12);
  builder.box(builder.material(flint()), {-2, 1.7, -2}, {2, 2, 2}, Facing::outside);
  addLight(builder, {0.3, 2.5, 0}, {0, -1, 0}, 3);
  builder.camera({0, 1.6, 0}, {0, 0, 0}, 1.3, kSize, kSize, {0, 0, 1});
}

void buildDispersingBall(SceneBuilder& builder) {
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 8);
  builder.icosphere(builder.material(flint()), {0, 1, 0}, 0.7, 3, Facing::outside, Shading::smooth);
  addLight(builder, {0.3, 3, -0.4}, {0, -1, 0}, 2);
  builder.camera({0, 1.2, 4}, {0, 0.4, 0}, 0.4, kSize, kSize);
}

Scene sceneOf(const Layered& layered) {
  SceneBuilder builder;
  layered.build(builder);
  Scene scene = builder.finish();
  if (layered.hasTangents)
    for (Vertex& vertex : scene.vertices) vertex.tangent = packTangent({1, 0, 0}, false);
  return scene;
}

/// Mean of each channel over the image, over seeds.
std::vector<Moments> channelMeans(const RenderJob& job, const Scene& scene) {
  constexpr int kSeeds = 8;
  return overSeeds(job, scene, kSeeds, [](const Rendered& rendered) {
    return std::vector<double>{meanOf(rendered.image, "R"), meanOf(rendered.image, "G"), meanOf(rendered.image, "B")};
  });
}

class LayeredPaths : public RenderTest, public ::testing::WithParamInterface<Layered> {};

/// As in path_class_test.cpp: two one-sided tests at a significance of 0.01 for each channel.
TEST_P(LayeredPaths, MapAndPathTracerAgree) {
  constexpr double kMargin = 0.02;
  const Layered& c = GetParam();
  const Scene scene = sceneOf(c);
  RenderJob path = makeJob(Integrator::path, 1);
  path.gather = c.paths;
  const std::vector<Moments> traced = channelMeans(path, scene);
  for (const GatherSource source : {GatherSource::cells, GatherSource::photons}) {
    if (source == GatherSource::photons && !c.hasPhotons) continue;
    RenderJob photon = makeJob(Integrator::photon, 2);
    photon.gather = c.gather;
    photon.photons = 1u << c.log2Photons;
    photon.gatherFrom = source;
    if (source == GatherSource::photons) photon.constantDensity = c.density;
    const std::vector<Moments> mapped = channelMeans(photon, scene);
    for (std::size_t channel = 0; channel < 3; ++channel)
      EXPECT_TRUE(areWithin(kMargin, mapped[channel], traced[channel]))
          << (source == GatherSource::cells ? "cells" : "photons") << ", channel " << channel;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, LayeredPaths,
                         ::testing::Values(Layered{"LeafLightsFloor", buildLeafLightsFloor, 512, 128, 15},
                                           Layered{"LightBehindLeaf", buildLightBehindLeaf, 1024, 256, 16},
                                           Layered{"WaxBall", buildWaxBall, 1024, 256, 17, true, false, 20000},
                                           Layered{"Sheen", buildSheen, 1024, 256, 14, false},
                                           Layered{"Anisotropy", buildAnisotropy, 1024, 256, 14, false, true},
                                           Layered{"Iridescence", buildIridescence, 1024, 1024, 14, false},
                                           Layered{"SmoothBubble", buildSmoothBubble, 2048, 512, 17, false},
                                           Layered{"RoughBubble", buildRoughBubble, 2048, 512, 17, false},
                                           Layered{"PaperBubble", buildPaperBubble, 2048, 512, 17, false},
                                           Layered{"Dispersion", buildDispersion, 2048, 256, 18, false},
                                           Layered{"DispersingBall", buildDispersingBall, 16384, 1024, 17, false}),
                         [](const auto& test) { return test.param.name; });

/// A sheet of colour before a uniform sky: what passes has the sheet's colour, and what is reflected its own.
TEST_F(Layers, TranslucentSheetsShowTheSkyBehindThem) {
  Material sheet = diffuse(vec3(0.4f));
  sheet.diffuseTransmission = 0.25f;
  sheet.diffuseTransmissionColor = vec3(0.8f);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    SceneBuilder builder;
    builder.square(builder.material(sheet), {0, 0, 0}, {0, 0, 1}, 2);
    builder.environment(vec3(1.0f));
    builder.camera({0, 0, 3}, {0, 0, 0}, 0.3, kSize, kSize);
    RenderJob job = makeJob(integrator, 1);
    job.gather = 16;
    const std::vector<Moments> light = channelMeans(job, builder.finish());
    EXPECT_TRUE(hasMean(light[0], 0.75 * 0.4 + 0.25 * 0.8, 2));
  }
}

/// A path goes on with one channel, brighter by as much as it is rarer.
TEST_F(Layers, DispersionKeepsTheMeanOfEachChannel) {
  SceneBuilder builder;
  builder.box(builder.material(flint()), {-1, -1, -1}, {1, 1, 1}, Facing::outside);
  builder.environment(vec3(1.0f));
  builder.camera({0, 0, 4}, {0, 0, 0}, 0.3, kSize, kSize);
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 256;
  job.maxDepth = 32;
  for (const Moments& light : channelMeans(job, builder.finish())) EXPECT_TRUE(hasMean(light, 1, 3));
}

}  // namespace
}  // namespace importon::test::layers_test
