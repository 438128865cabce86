// Photons against paths from the eye: the same light, through glass, over textures and normal maps.
#include "render_helper.h"
#include "scene/packing.h"

namespace importon::test::adjoint_test {
namespace {

constexpr int kSize = 8;

class Adjoint : public RenderTest {};

/// Adds a texture of 2 x 2 texels, RGBA8, that repeats `repeats` times over its UV set.
uint addTexture(Scene& scene, const std::vector<uint>& texels, bool isSrgb, float repeats) {
  Texture texture{};
  texture.firstTexel = static_cast<uint>(scene.texels.size());
  texture.width = texture.height = 2;
  texture.isSrgb = isSrgb ? 1 : 0;
  texture.uvRow0 = vec3(repeats, 0, 0);
  texture.uvRow1 = vec3(0, repeats, 0);
  scene.texels.insert(scene.texels.end(), texels.begin(), texels.end());
  scene.textures.push_back(texture);
  return static_cast<uint>(scene.textures.size() - 1);
}

/// Gives all surfaces of a material a base colour texture and normals that lean over by up to 20 degrees.
void addRelief(Scene& scene, uint material, const glm::dvec3& normal) {
  glm::dvec3 tangent, bitangent;
  tangentFrame(normal, tangent, bitangent);
  scene.materials[material].baseColorTexture =
      addTexture(scene, {0xFFFFFFFFu, 0xFF8080C0u, 0xFF80C080u, 0xFFC0C0C0u}, true, 7);
  scene.materials[material].normalTexture =
      addTexture(scene, {0xFFF080A8u, 0xFFF08058u, 0xFFF0A880u, 0xFFF05880u}, false, 11);
  for (const Triangle& t : scene.triangles) {
    if (t.material != material) continue;
    for (const uint vertex : {t.v0, t.v1, t.v2}) scene.vertices[vertex].tangent = packTangent(tangent, false);
  }
}

/// A floor and a wall in relief, under a light that shines on them through a ball of glass and beside it.
Scene reliefUnderGlass() {
  SceneBuilder builder;
  const uint floor = builder.material(diffuse(vec3(0.8f))), wall = builder.material(diffuse(vec3(0.8f)));
  builder.square(floor, {0, 0, 0}, {0, 1, 0}, 6);
  builder.square(wall, {0, 2, -1.5}, {0, 0, 1}, 6);
  builder.icosphere(builder.material(glass(1.5f)), {0, 1, 0}, 0.7, 3, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(vec3(5.0f))), {0.3, 3, -0.4}, {0, -1, 0}, 3);
  builder.camera({0, 1.2, 4}, {0, 0.5, 0}, 0.6, kSize, kSize);
  Scene scene = builder.finish();
  addRelief(scene, floor, {0, 1, 0});
  addRelief(scene, wall, {0, 0, 1});
  return scene;
}

/// A floor whose normals all lean by 35 degrees towards +x, under a lamp above it. A plate on that side sees it; or,
/// with a detour, sees only a ceiling that the floor lights. Nothing is seen from behind a normal, where no two ways to
/// trace agree on what a surface reflects.
Scene leaningFloor(bool hasDetour) {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.8f))), floor = builder.material(diffuse(vec3(0.8f)));
  builder.square(floor, {0, 0, 0}, {0, 1, 0}, 1);
  builder.spotLight({0, 1, 0}, {0, -1, 0}, vec3(5.0f), 0.3, 0.4);
  builder.square(white, {2.2, 0.6, 0}, {-1, 0.3, 0}, 1);
  if (hasDetour) {
    builder.square(white, {0.86, 1.23, 0}, {0, -1, 0}, 0.8);
    builder.quad(builder.material(diffuse(vec3(0.0f))), {1.5, -0.2, -3}, {0, 1, 0}, {0, 0, 6});
  }
  builder.camera({1.6, 1.8, 0}, {2.2, 0.6, 0}, 0.3, kSize, kSize);
  Scene scene = builder.finish();
  constexpr uint kLeaning = 0xFFE880C9u;  // 0.57, 0, 0.82
  scene.materials[floor].normalTexture = addTexture(scene, {kLeaning, kLeaning, kLeaning, kLeaning}, false, 1);
  for (const Triangle& t : scene.triangles)
    if (t.material == floor)
      for (const uint vertex : {t.v0, t.v1, t.v2}) scene.vertices[vertex].tangent = packTangent({1, 0, 0}, false);
  return scene;
}

/// Photons count flux by the true surface and scatter by the shading normal: what the two differ by does not cancel
/// here, and is a fifth of the light at least.
testing::AssertionResult photonsBringWhatPathsFind(bool hasDetour, GatherSource source, int paths, int seeds) {
  const Scene scene = leaningFloor(hasDetour);
  RenderJob path = makeJob(Integrator::path, 1);
  path.gather = paths;
  RenderJob photon = makeJob(Integrator::photon, 2);
  photon.photons = 1u << 17;
  photon.gather = 1024;
  photon.gatherFrom = source;
  if (source == GatherSource::photons) photon.constantDensity = 20000;
  return areWithin(0.05, meanOverSeeds(photon, scene, seeds), meanOverSeeds(path, scene, seeds));
}

TEST_F(Adjoint, PhotonsBringWhatPathsFindWhereAllNormalsLeanOneWay) {
  EXPECT_TRUE(photonsBringWhatPathsFind(false, GatherSource::cells, 1 << 12, 8));
}

TEST_F(Adjoint, PhotonsOfTheMapBringWhatPathsFind) {
  EXPECT_TRUE(photonsBringWhatPathsFind(false, GatherSource::photons, 1 << 12, 8));
}

TEST_F(Adjoint, PhotonsBringWhatPathsFindByADetourOverLeaningNormals) {
  EXPECT_TRUE(photonsBringWhatPathsFind(true, GatherSource::cells, 1 << 15, 11));
}

/// Case 7.
TEST_F(Adjoint, PhotonsBringWhatPathsFindThroughGlassOverTexturesAndNormalMaps) {
  const StabilityCase listed(7, "photons against paths over glass, textures and normal maps", "the same mean");
  const Scene scene = reliefUnderGlass();
  RenderJob path = makeJob(Integrator::path, 1);
  path.gather = 1024;
  RenderJob photon = makeJob(Integrator::photon, 2);
  photon.photons = 1u << 16;
  photon.gather = 256;
  const Moments traced = meanOverSeeds(path, scene, 8), mapped = meanOverSeeds(photon, scene, 8);
  EXPECT_TRUE(areWithin(0.02, mapped, traced));
}

}  // namespace
}  // namespace importon::test::adjoint_test
