// kernels/traversal/trace_alpha.comp: rays pass where a material has holes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "accel/ray_tracer.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon::test {
namespace {

constexpr std::size_t kRays = 40000;

/// A sheet at y = 1 with this material over an opaque floor at y = 0, both over [0, 1]².
Scene sheetOverFloor(const Material& sheet) {
  SceneBuilder builder;
  const uint top = builder.material(sheet), floor = builder.material(diffuse(vec3(0.5f)));
  builder.quad(top, {0, 1, 1}, {1, 0, 0}, {0, 0, -1});
  builder.quad(floor, {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  builder.pointLight({0.5, 2, 0.5}, vec3(1.0f));
  return builder.finish();
}

/// Straight down from above the sheet, each with its own id; they end below the floor.
std::vector<Ray> raysDown(const Scene& scene) {
  std::vector<Ray> rays;
  const vec3 size = scene.boundsMax - scene.boundsMin;
  for (std::size_t i = 0; i < kRays; ++i) {
    const float u = (static_cast<float>(i % 200) + 0.5f) / 200, v = (static_cast<float>(i / 200) + 0.5f) / 200;
    const vec3 start = scene.boundsMin + vec3(u, 1.5f, v) * size;
    rays.push_back({start, 0.9f, vec3(0, -1, 0), static_cast<uint>(i)});
  }
  return rays;
}

bool isSheet(const Scene& scene, const Hit& hit) {
  return hit.triangle != kNone && scene.triangles[hit.triangle].material == 0;
}

class AlphaTest : public GpuTest {
 protected:
  /// Fraction of the rays that the sheet stops.
  double stopped(const Scene& scene) const {
    RayTracer tracer(context(), buildBvh(scene.positions, scene.triangles), scene);
    std::vector<Ray> rays = raysDown(scene);
    const std::vector<Hit> any = tracer.anyHits(rays);
    for (Ray& ray : rays) ray.tMax = std::numeric_limits<float>::infinity();
    const std::vector<Hit> closest = tracer.closestHits(rays);
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_NE(closest[i].triangle, kNone) << i;
      EXPECT_EQ(isSheet(scene, closest[i]), any[i].triangle != kNone) << i;
      count += isSheet(scene, closest[i]) ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(rays.size());
  }
};

Material withAlpha(float alpha, uint mode) {
  Material material = diffuse(vec3(0.5f));
  material.baseColor.a = alpha;
  material.flags |= mode;
  return material;
}

/// Left half (u < 1/2) of alpha 0, right half of alpha 255.
void addHalfTexture(Scene& scene) {
  scene.texels = {0x00FFFFFFu, 0xFFFFFFFFu};
  Texture texture{};
  texture.width = 2;
  texture.height = 1;
  texture.isNearest = 1;
  texture.uvRow0 = vec3(1, 0, 0);
  texture.uvRow1 = vec3(0, 1, 0);
  scene.textures = {texture};
  scene.materials[0].baseColorTexture = 0;
}

}  // namespace

TEST_F(AlphaTest, OpaqueMaterialsStopRaysWhateverTheirAlpha) {
  EXPECT_EQ(stopped(sheetOverFloor(withAlpha(0.0f, 0))), 1.0);
}

TEST_F(AlphaTest, MaskedMaterialsStopRaysFromTheCutoffOn) {
  EXPECT_EQ(stopped(sheetOverFloor(withAlpha(0.49f, kMaterialAlphaMask))), 0.0);
  EXPECT_EQ(stopped(sheetOverFloor(withAlpha(0.51f, kMaterialAlphaMask))), 1.0);
}

TEST_F(AlphaTest, BlendedMaterialsStopTheShareOfRaysThatIsTheirAlpha) {
  for (const double alpha : {0.0, 0.1, 0.7, 1.0}) {
    // Five standard deviations: a false alarm once in 10^6 runs with other hashes.
    const double deviation = std::sqrt(alpha * (1 - alpha) / kRays);
    EXPECT_NEAR(stopped(sheetOverFloor(withAlpha(static_cast<float>(alpha), kMaterialAlphaBlend))), alpha,
                5 * deviation);
  }
}

/// A triangle in several leaves must stop a ray in all of them or in none.
TEST_F(AlphaTest, TrianglesThatAreCutStopTheirShareOfRaysOnce) {
  constexpr double kAlpha = 0.6;
  SceneBuilder builder;
  const uint sheet = builder.material(withAlpha(static_cast<float>(kAlpha), kMaterialAlphaBlend));
  for (int i = 0; i < 40; ++i) builder.triangle(sheet, {0.05 * i, 0, 0}, {1 + 0.05 * i, 1, 1}, {0.05 + 0.05 * i, 0, 0});
  for (int i = 0; i < 400; ++i)  // so that there may be parts
    builder.triangle(sheet, {0.005 * i, 0, 1}, {0.005 * i + 0.001, 0, 1}, {0.005 * i, 0, 0.999});
  builder.pointLight({0.5, 2, 0.5}, vec3(1.0f));
  const Scene scene = builder.finish();
  const Bvh bvh = buildBvh(scene.positions, scene.triangles);
  EXPECT_GT(std::count_if(bvh.nodes.begin(), bvh.nodes.end(), isLeaf), 440);
  RayTracer opaque(context(), bvh), tracer(context(), bvh, scene);
  std::vector<Ray> rays = raysDown(scene);
  for (Ray& ray : rays) ray.tMax = 10 * (scene.boundsMax.y - scene.boundsMin.y);
  const std::vector<Hit> all = opaque.closestHits(rays), closest = tracer.closestHits(rays), any = tracer.anyHits(rays);
  double reached = 0, stopped = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(closest[i].triangle == kNone, any[i].triangle == kNone) << i;
    reached += all[i].triangle != kNone ? 1 : 0;
    stopped += closest[i].triangle != kNone ? 1 : 0;
  }
  ASSERT_GT(reached, kRays / 10.0);
  // Five standard deviations: a false alarm once in 10^6 runs with other hashes.
  EXPECT_NEAR(stopped / reached, kAlpha, 5 * std::sqrt(kAlpha * (1 - kAlpha) / reached));
}

TEST_F(AlphaTest, TheTexturesAlphaCounts) {
  Scene scene = sheetOverFloor(withAlpha(1.0f, kMaterialAlphaMask));
  addHalfTexture(scene);
  EXPECT_NEAR(stopped(scene), 0.5, 1e-9);
}

}  // namespace importon::test
