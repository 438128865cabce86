// Rays through a tree above trees, against the same triangles flattened.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "accel/ray_tracer.h"
#include "render/device_scene/instances.h"
#include "support/gpu_test.h"
#include "support/placed_scene.h"
#include "support/scene_builder.h"

namespace importon::test {
namespace {

/// A floor of two triangles, and a ball and a box on it that are kept once.
Scene scene(const std::vector<glm::dmat4>& places, Held held) {
  SceneBuilder world, object;
  world.square(world.material(diffuse(vec3(0.5f))), {0, -1.5, 0}, {0, 1, 0}, 20);
  world.pointLight({0, 9, 0}, vec3(1));
  object.icosphere(object.material(diffuse(vec3(0.5f))), {0.3, 0, 0}, 1, 3, Facing::outside, Shading::flat);
  object.box(object.material(diffuse(vec3(0.2f))), {-1, -1, -1}, {0, 0, 0}, Facing::outside);
  return withInstances(world.finish(), object.finish(), places, held);
}

/// From points around a scene of that size into all directions.
std::vector<Ray> raysAround(std::size_t count, float size, const vec3& centre = vec3(0)) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const vec3 direction(unit(random), unit(random), unit(random));
    if (glm::length(direction) < 0.1f) continue;
    const vec3 origin = centre + size * vec3(unit(random), 0.3f * unit(random), unit(random));
    rays.push_back(
        {origin, std::numeric_limits<float>::infinity(), glm::normalize(direction), static_cast<uint>(rays.size())});
  }
  return rays;
}

class TwoLevelTest : public GpuTest {
 protected:
  /// All but a few of the rays, which pass near an edge, meet the same instance at the same distance. Returns how many
  /// meet an instance.
  std::size_t expectAsFlattened(const std::vector<glm::dmat4>& places, const std::vector<Ray>& rays,
                                double reach) const {
    const Scene placed = scene(places, Held::once), flat = scene(places, Held::flattened);
    EXPECT_FALSE(placed.placed.isEmpty());
    EXPECT_TRUE(flat.placed.isEmpty());
    EXPECT_EQ(placed.shownTriangleCount(), flat.triangles.size());
    RayTracer tracer(context(), buildSceneTree(placed, {}), placed),
        reference(context(), buildSceneTree(flat, {}), flat);
    const std::vector<Hit> found = tracer.closestHits(rays), expected = reference.closestHits(rays);
    std::size_t different = 0, instances = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool isMiss = found[i].triangle == kNone;
      if (!isMiss && (found[i].triangle & kPlacedTriangle) != 0) ++instances;
      const double apart = isMiss ? 0 : std::abs(static_cast<double>(found[i].t) - static_cast<double>(expected[i].t));
      if (isMiss != (expected[i].triangle == kNone) || apart > 2e-5 * reach) ++different;
    }
    EXPECT_LE(different, rays.size() / 2000);
    const std::vector<Hit> any = tracer.anyHits(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(any[i].triangle == kNone, found[i].triangle == kNone) << i;
    EXPECT_EQ(tracer.unfinished(), 0u);
    return instances;
  }
};

TEST_F(TwoLevelTest, RaysMeetTurnedInstancesAsTheyMeetFlattenedOnes) {
  EXPECT_GT(expectAsFlattened(scattered(60, 2.5, false), raysAround(20000, 10), 10), 4000u);
}

TEST_F(TwoLevelTest, RaysMeetStretchedAndMirroredInstances) {
  EXPECT_GT(expectAsFlattened(scattered(60, 2.5, true), raysAround(20000, 10), 10), 4000u);
}

TEST_F(TwoLevelTest, RaysFromFarAwayMeetSmallInstances) {
  std::vector<glm::dmat4> places;
  for (const glm::dmat4& place : scattered(60, 2.5, true))
    places.push_back(place * glm::scale(glm::dmat4(1.0), glm::dvec3(1e-2)));
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (const float distance : {1e3f, 1e4f, 1e5f}) {
    SCOPED_TRACE(distance);
    std::vector<Ray> rays;
    for (uint i = 0; i < 20000; ++i) {
      const vec3 origin = distance * glm::normalize(vec3(normal(random), std::abs(normal(random)), normal(random)));
      const vec3 spread = 0.007f * vec3(normal(random), normal(random), normal(random));
      const vec3 aim = vec3(places[i % places.size()][3]) + spread;
      rays.push_back({origin, std::numeric_limits<float>::infinity(), glm::normalize(aim - origin), i});
    }
    EXPECT_GT(expectAsFlattened(places, rays, distance), 4000u);
  }
}

TEST_F(TwoLevelTest, HitsTellTheTriangleByItsNumber) {
  const Scene placed = scene(scattered(60, 2.5, true), Held::once);
  const std::vector<Ray> rays = raysAround(5000, 10);
  RayTracer tracer(context(), buildSceneTree(placed, {}), placed);
  const std::vector<Hit> hits = tracer.closestHits(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = hits[i];
    if (hit.triangle == kNone || (hit.triangle & kPlacedTriangle) == 0) continue;
    const uint page = (hit.triangle & ~kPlacedTriangle) >> kPageBits;
    const PlacedInstance& instance = placed.placed.instances[instancesOfPages(placed.placed)[page] - 1];
    const PlacedMesh& mesh = placed.placed.meshes[instance.mesh];
    const uint local = (page - instance.firstPage) * kPageTriangles + (hit.triangle & (kPageTriangles - 1));
    ASSERT_LT(local, mesh.triangleCount);
    const Triangle& t = placed.triangles[mesh.firstTriangle + local];
    const vec3 point =
        (1 - hit.u - hit.v) * placed.positions[t.v0] + hit.u * placed.positions[t.v1] + hit.v * placed.positions[t.v2];
    const vec3 met = rays[i].origin + hit.t * rays[i].direction;
    EXPECT_LT(glm::length(vec3(instance.placement()(point)) - met), 1e-4f) << i;
  }
}

TEST_F(TwoLevelTest, SceneOfInstancesAloneIsTraced) {
  SceneBuilder world, object;
  world.triangle(world.material(diffuse(vec3(0.5f))), {0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0});
  object.icosphere(object.material(diffuse(vec3(0.5f))), {0, 0, 0}, 1, 2, Facing::outside, Shading::flat);
  const Scene placed = withInstances(world.finish(), object.finish(), scattered(2, 3, false), Held::once);
  Bvh tree = buildSceneTree(placed, {});
  EXPECT_LE(tree.depth, kBvhMaxDepth);
  RayTracer tracer(context(), tree, placed);
  const Hit hit = tracer.closestHits(std::vector<Ray>{{vec3(-1.5f, 5, -1.5f), 1e9f, vec3(0, -1, 0), 0}}).front();
  EXPECT_NE(hit.triangle, kNone);
}

}  // namespace
}  // namespace importon::test
