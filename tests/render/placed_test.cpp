// Images of meshes that stand in many places: the same whether the scene holds them once or flattened.
#include <glm/gtc/matrix_transform.hpp>

#include "render_helper.h"
#include "support/placed_scene.h"

namespace importon::test::placed_test {
namespace {

constexpr int kSize = 32;

/// A room with a lamp, to be filled.
Scene room() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f, 0.5f, 0.4f))), {-4, -1, -4}, {4, 5, 4}, Facing::inside);
  builder.square(builder.material(emitter(vec3(6, 5, 4))), {0, 4.9, 0}, {0, -1, 0}, 2);
  builder.pointLight({-3, 3, 3}, vec3(8));
  builder.camera({0, 3, 3.9}, {0, -0.5, -1}, 1.1, kSize, kSize);
  return builder.finish();
}

/// Something with an edge on a ball: flat and smooth, and not alike from any two sides.
Scene object(const Material& material, Shading shading = Shading::smooth) {
  SceneBuilder builder;
  builder.icosphere(builder.material(material), {0, 0, 0}, 0.5, 3, Facing::outside, shading);
  return builder.finish();
}

struct Pair {
  Scene placed, flat;
};

Pair pairOf(const Scene& object, bool isStretched = true) {
  const std::vector<glm::dmat4> places = scattered(25, 1.4, isStretched);
  Pair pair{withInstances(room(), object, places, Held::once), withInstances(room(), object, places, Held::flattened)};
  EXPECT_EQ(pair.placed.placed.instances.size(), 25u);
  EXPECT_TRUE(pair.flat.placed.isEmpty());
  return pair;
}

/// Share of pixels whose values differ by more than rounding explains.
double shareOfDifferent(const Image& a, const Image& b) {
  std::size_t different = 0, count = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float> left = valuesOf(a, channel), right = valuesOf(b, channel);
    for (std::size_t i = 0; i < left.size(); ++i, ++count)
      if (std::abs(left[i] - right[i]) > 1e-3f * (std::abs(left[i]) + 1e-2f)) ++different;
  }
  return static_cast<double>(different) / static_cast<double>(count);
}

/// The same paths meet the same surfaces, but for a few that pass an edge within rounding.
void expectTheSamePaths(const Pair& pair, double most = 0.02) {
  const RenderJob job = makeJob(Integrator::path, 4);
  const Image placed = renderScene(job, pair.placed).image, flat = renderScene(job, pair.flat).image;
  EXPECT_TRUE(isSane(placed));
  EXPECT_LT(shareOfDifferent(placed, flat), most);
}

class Placed : public RenderTest {};

TEST_F(Placed, DiffuseMeshesGiveTheSamePaths) { expectTheSamePaths(pairOf(object(diffuse(vec3(0.7f))))); }

TEST_F(Placed, FacetedMeshesGiveTheSamePaths) {
  expectTheSamePaths(pairOf(object(diffuse(vec3(0.7f)), Shading::flat)));
}

TEST_F(Placed, MirrorsGiveTheSamePaths) { expectTheSamePaths(pairOf(object(metal(vec3(0.8f), 0.2f))), 0.1); }

TEST_F(Placed, SolidsOfGlassGiveTheSamePaths) {
  expectTheSamePaths(pairOf(object(glass(1.5f, vec3(0.1f, 1, 2)))), 0.15);
}

TEST_F(Placed, MeshesWithHolesGiveTheSamePaths) {
  Material cut = diffuse(vec3(0.7f));
  cut.flags |= kMaterialDoubleSided | kMaterialAlphaBlend;
  cut.baseColor.w = 0.5f;
  // Holes are drawn by the number of the triangle, which is another: alike in the mean.
  const Pair pair = pairOf(object(cut));
  const RenderJob job = makeJob(Integrator::path, 8);
  EXPECT_TRUE(haveSameMean(meanOverSeeds(job, pair.placed, 8), meanOverSeeds(job, pair.flat, 8)));
}

TEST_F(Placed, MeshesGiveTheSameImageByPhotons) {
  for (const Material& material : {diffuse(vec3(0.7f)), glass(1.5f)}) {
    const Pair pair = pairOf(object(material));
    const RenderJob job = makeJob(Integrator::photon, 4);
    EXPECT_TRUE(haveSameMean(meanOverSeeds(job, pair.placed, 6), meanOverSeeds(job, pair.flat, 6), 2));
  }
}

TEST_F(Placed, LightInCellsIsKeptToTheBit) {
  const Rendered rendered = renderScene(makeJob(Integrator::photon, 2), pairOf(object(diffuse(vec3(0.7f)))).placed);
  EXPECT_TRUE(rendered.warnings.empty());
  EXPECT_TRUE(isSane(rendered.image));
}

TEST_F(Placed, LayersTellWhatIsSeen) {
  const Pair pair = pairOf(object(diffuse(vec3(0.7f))));
  RenderJob job = makeJob(Integrator::photon, 1);
  job.aovs = {"N", "P", "density.global"};
  const Image placed = renderScene(job, pair.placed).image, flat = renderScene(job, pair.flat).image;
  for (const char* channel : {"N.X", "N.Y", "P.Z"}) {
    const std::vector<float> a = valuesOf(placed, channel), b = valuesOf(flat, channel);
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (std::abs(a[i] - b[i]) > 1e-3f) ++different;
    EXPECT_LE(different, a.size() / 100) << channel;
  }
}

}  // namespace
}  // namespace importon::test::placed_test
