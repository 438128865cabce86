// kernels/traversal/trace.comp against the same intersection routine over all triangles, without a BVH.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "accel/exact_oracle.h"
#include "accel/meshes.h"
#include "accel/ray_tracer.h"
#include "accel_test_kernels/registry.h"
#include "support/gpu_test.h"

namespace importon::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct BruteForcePush {
  std::uint32_t count, triangleCount;
};

std::vector<BvhRecord> leafRecords(const Bvh& bvh) {
  std::vector<BvhRecord> leaves;
  for (const BvhRecord& record : bvh.nodes)
    if (isLeaf(record)) leaves.push_back(record);
  return leaves;
}

class TraverseTest : public GpuTest {
 protected:
  /// At most 60000 triangles: lavapipe ends loops after 65535 iterations.
  std::vector<Hit> bruteForce(const Bvh& bvh, const std::vector<Ray>& rays) const {
    const std::vector<BvhRecord> leaves = leafRecords(bvh);
    EXPECT_LE(leaves.size(), 60000u);
    const gpu::Kernel kernel(context(), "brute force", accel_test_kernels::code("brute_force"));
    const gpu::Buffer rayBuffer = gpu::makeBuffer<Ray>(context(), "rays", rays);
    const gpu::Buffer hits(context(), "hits", rays.size() * sizeof(Hit));
    const gpu::Buffer triangles = gpu::makeBuffer<BvhRecord>(context(), "triangles", leaves, gpu::TexelFormat::uint4);
    const gpu::Buffer* const bindings[] = {&rayBuffer, &hits, &triangles};
    gpu::Recorder recorder(context());
    recorder.dispatch(
        kernel, bindings, rays.size(),
        BruteForcePush{static_cast<std::uint32_t>(rays.size()), static_cast<std::uint32_t>(leaves.size())});
    recorder.submitAndWait();
    return hits.download<Hit>(rays.size());
  }

  /// Kinds of rays: from surfaces, along axes (many in line with vertices), and at vertices and edges.
  static std::vector<Ray> allKinds(const Mesh& mesh, std::size_t each) {
    std::vector<Ray> rays = surfaceRays(mesh, each, 11);
    for (const std::vector<Ray>& more : {axisRays(mesh, each, 12), grazingRays(mesh, each, 13)})
      rays.insert(rays.end(), more.begin(), more.end());
    return rays;
  }

  /// The same triangle at the same t for every ray. Brute force may also find a triangle that the ray lies in
  /// the plane of and passes outside: there rounding can turn a small negative area into zero, and no box keeps
  /// the ray away. Such a difference is judged in double precision.
  void expectAsBruteForce(const Mesh& mesh, const std::vector<Ray>& rays) const {
    const Bvh bvh = buildBvh(mesh.positions, mesh.triangles);
    RayTracer tracer(context(), bvh);
    const std::vector<Hit> found = tracer.closestHits(rays), expected = bruteForce(bvh, rays);
    std::size_t hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (expected[i].triangle != kNone) ++hits;
      if (found[i].triangle == expected[i].triangle && found[i].t == expected[i].t) continue;
      ++different;
      const NearestHit nearest = nearestHit(mesh, rays[i], 16 * 0x1p-24);
      const double t = found[i].triangle == kNone ? kInfinity : found[i].t;
      EXPECT_TRUE(t >= nearest.possible && t <= nearest.certain && expected[i].t < nearest.possible)
          << "ray " << i << ": triangle " << found[i].triangle << " at " << t << " instead of " << expected[i].triangle
          << " at " << expected[i].t << ", nearest possible " << nearest.possible << ", certain " << nearest.certain;
    }
    EXPECT_LE(different, rays.size() / 1000);
    EXPECT_GT(hits, rays.size() / 20);
    EXPECT_EQ(tracer.unfinished(), 0u);
  }
};

Mesh fourCopies(const Mesh& mesh) {
  Mesh copies = mesh;
  for (int copy = 0; copy < 3; ++copy)
    copies.triangles.insert(copies.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  return copies;
}

Mesh needles(std::size_t count) {
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i) / static_cast<float>(count);
    const float next = static_cast<float>(i + 1) / static_cast<float>(count);
    mesh.add({x, 0, 0.1f * x}, {next, 0, 0.1f * next}, {x, 1, 0.1f * x});
    mesh.add({next, 0, 0.1f * next}, {next, 1, 0.1f * next}, {x, 1, 0.1f * x});
  }
  return mesh;
}

}  // namespace

TEST_F(TraverseTest, FindsWhatBruteForceFindsAmongRandomTriangles) {
  for (const std::size_t count : {1u, 2u, 4u, 5u, 50u, 3000u}) {
    const Mesh mesh = randomTriangles(count, count < 100 ? 0.8f : 0.1f, 21);
    expectAsBruteForce(mesh, allKinds(mesh, 2000));
  }
}

TEST_F(TraverseTest, FindsWhatBruteForceFindsOnAMeshWithSharedEdges) {
  const Mesh mesh = heightField(40);
  expectAsBruteForce(mesh, allKinds(mesh, 3000));
}

TEST_F(TraverseTest, FindsWhatBruteForceFindsInABoxWithAxisParallelWalls) {
  const Mesh mesh = closedBox(vec3(-1, -2, -3), vec3(4, 5, 6));
  expectAsBruteForce(mesh, allKinds(mesh, 5000));
}

TEST_F(TraverseTest, FindsWhatBruteForceFindsAmongHugeAndTinyTriangles) {
  Mesh mesh = randomTriangles(1000, 1e-4f, 22);
  mesh.add({-1e6f, -1e6f, 0.5f}, {1e6f, -1e6f, 0.5f}, {0, 1e6f, 0.5f});
  mesh.add({0.3f, -1e4f, -1e4f}, {0.3f, 1e4f, -1e4f}, {0.3f, 0, 1e4f});
  std::vector<Ray> rays = grazingRays(randomTriangles(500, 0.1f, 23), 3000, 24);
  for (const Ray& ray : surfaceRays(randomTriangles(1000, 1e-4f, 22), 3000, 25)) rays.push_back(ray);
  expectAsBruteForce(mesh, rays);
}

TEST_F(TraverseTest, FindsWhatBruteForceFindsAmongNeedles) {
  const Mesh mesh = needles(2000);
  expectAsBruteForce(mesh, allKinds(mesh, 2000));
}

TEST_F(TraverseTest, FindsWhatBruteForceFindsAmongTrianglesThatAreCut) {
  const Mesh mesh = slats(300, 31);
  const Bvh bvh = buildBvh(mesh.positions, mesh.triangles);
  EXPECT_GT(leafRecords(bvh).size(), 1.05 * static_cast<double>(mesh.triangles.size()));
  expectAsBruteForce(mesh, allKinds(mesh, 2000));
}

TEST_F(TraverseTest, OfCoincidentTrianglesThatAreCutTakesTheSmallestIndex) {
  const Mesh once = slats(300, 32);
  const Mesh mesh = fourCopies(once);
  expectAsBruteForce(mesh, allKinds(mesh, 1000));
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  for (const Hit& hit : tracer.closestHits(surfaceRays(once, 3000, 33)))
    EXPECT_TRUE(hit.triangle == kNone || hit.triangle < once.triangles.size());
}

TEST_F(TraverseTest, OfCoincidentTrianglesTakesTheSmallestIndex) {
  const Mesh once = heightField(20);
  const Mesh mesh = fourCopies(once);
  expectAsBruteForce(mesh, allKinds(mesh, 2000));
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  for (const Hit& hit : tracer.closestHits(surfaceRays(once, 3000, 26)))
    EXPECT_TRUE(hit.triangle == kNone || hit.triangle < once.triangles.size());
}

TEST_F(TraverseTest, FinishesAmongAHundredThousandIdenticalTriangles) {
  Mesh mesh = randomTriangles(20, 1.0f, 27);
  for (int i = 0; i < 100000; ++i) mesh.triangles.push_back(mesh.triangles[3]);
  expectAsBruteForce(mesh, allKinds(mesh, 1000));
}

TEST_F(TraverseTest, LosesNoRayThroughEdgesAndCornersOfAClosedBox) {
  const Mesh mesh = closedBox(vec3(-1, -0.7f, -0.3f), vec3(0.9f, 1.1f, 0.6f));
  std::vector<Ray> rays = grazingRays(mesh, 60000, 28);
  const vec3 inside(0.05f, 0.1f, 0.2f);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const vec3 target = rays[i].origin + rays[i].direction;
    rays[i].origin = inside + 0.01f * glm::fract(target);
    const vec3 corner = mesh.positions[i % 8], other = mesh.positions[(i / 8) % 8];
    rays[i].direction = glm::normalize(glm::mix(corner, other, glm::fract(target.x * 7)) - rays[i].origin);
  }
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  std::size_t lost = 0;
  for (const Hit& hit : tracer.closestHits(rays)) lost += hit.triangle == kNone ? 1 : 0;
  EXPECT_EQ(lost, 0u);
}

TEST_F(TraverseTest, AnyHitSaysWhetherTheClosestHitLiesBeforeTheEnd) {
  for (const Mesh& mesh : {randomTriangles(3000, 0.1f, 29), heightField(60), slats(300, 34)}) {
    std::vector<Ray> rays = segmentRays(mesh, 20000, 30);
    RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
    const std::vector<Hit> any = tracer.anyHits(rays), closest = tracer.closestHits(rays);
    std::size_t blocked = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool isBlocked = closest[i].triangle != kNone && closest[i].t < rays[i].tMax;
      EXPECT_EQ(any[i].triangle != kNone, isBlocked) << i;
      blocked += isBlocked ? 1 : 0;
    }
    EXPECT_GT(blocked, rays.size() / 10);
    EXPECT_LT(blocked, rays.size());
  }
}

TEST_F(TraverseTest, RespectsTheEndOfTheRay) {
  Mesh mesh;
  mesh.add({-1, -1, 2}, {1, -1, 2}, {0, 1, 2});
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  const float before = std::nextafter(2.0f, 0.0f), after = std::nextafter(2.0f, 3.0f);
  std::vector<Ray> rays;
  for (const float tMax : {before, 2.0f, after, kInfinity, 0.0f, -1.0f})
    rays.push_back({vec3(0), tMax, vec3(0, 0, 1), 0});
  const std::vector<Hit> closest = tracer.closestHits(rays), any = tracer.anyHits(rays);
  const std::vector<bool> isHit{false, true, true, true, false, false},
      isBlocked{false, false, true, true, false, false};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(closest[i].triangle == 0, isHit[i]) << rays[i].tMax;
    EXPECT_EQ(any[i].triangle == 0, isBlocked[i]) << rays[i].tMax;
  }
  EXPECT_EQ(closest[3].t, 2.0f);
}

TEST_F(TraverseTest, ReportsBarycentricsOfTheSceneVertices) {
  const vec3 corners[3] = {vec3(0, 0, 1), vec3(8, 0, 1), vec3(7, 2, 1)};
  for (std::size_t first = 0; first < 3; ++first) {
    Mesh mesh;
    mesh.add(corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]);
    const float u = 0.25f, v = 0.5f;
    const vec3 point = mesh.positions[0] * (1 - u - v) + mesh.positions[1] * u + mesh.positions[2] * v;
    RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
    const std::vector<Hit> hits =
        tracer.closestHits(std::vector<Ray>{{point - vec3(0, 0, 1), kInfinity, vec3(0, 0, 1), 0}});
    EXPECT_NEAR(hits[0].u, u, 1e-6f);
    EXPECT_NEAR(hits[0].v, v, 1e-6f);
  }
}

TEST_F(TraverseTest, GivesTheSameBitsForASceneScaledByAPowerOfTwo) {
  const Mesh mesh = heightField(50);
  const std::vector<Ray> rays = allKinds(mesh, 3000);
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  const std::vector<Hit> before = tracer.closestHits(rays);
  for (const float scale : {0x1p-13f, 0x1p20f}) {
    Mesh scaledMesh = mesh;
    for (vec3& p : scaledMesh.positions) p *= scale;
    std::vector<Ray> scaledRays = rays;
    for (Ray& ray : scaledRays) ray.origin *= scale;
    RayTracer scaledTracer(context(), buildBvh(scaledMesh.positions, scaledMesh.triangles));
    const std::vector<Hit> after = scaledTracer.closestHits(scaledRays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(before[i].triangle, after[i].triangle) << i;
      if (before[i].triangle == kNone) continue;
      EXPECT_EQ(before[i].t * scale, after[i].t);
      EXPECT_EQ(before[i].u, after[i].u);
      EXPECT_EQ(before[i].v, after[i].v);
    }
  }
}

TEST_F(TraverseTest, GivesTheSameBitsAgainAndForAnyQueueLength) {
  const Mesh mesh = randomTriangles(5000, 0.1f, 31);
  const std::vector<Ray> rays = surfaceRays(mesh, 70001, 32);
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  const std::vector<Hit> once = tracer.closestHits(rays), again = tracer.closestHits(rays);
  EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof(Hit)), 0);
  for (const std::size_t length : {1u, 7u, 64u, 3000u}) {
    const std::vector<Hit> few = tracer.closestHits(std::span(rays).first(length));
    EXPECT_EQ(std::memcmp(once.data(), few.data(), length * sizeof(Hit)), 0) << length;
  }
}

TEST_F(TraverseTest, CountsTheRaysThatTheDevicesLimitOnLoopsCutsShort) {
  // Slivers along a diagonal: the rays pass through the boxes of all of them and meet none.
  Mesh mesh;
  for (int i = 0; i < 100000; ++i) {
    const float shift = 1e-7f * static_cast<float>(i);
    mesh.add({shift, 0, 0}, {1, 1, 1 + shift}, {shift, 0, 1e-6f});
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 20; ++i)
    rays.push_back({vec3(-1, 0.9f, 0.1f + 1e-3f * static_cast<float>(i)), kInfinity, vec3(1, 0, 0), 0});
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  for (const Hit& hit : tracer.closestHits(rays)) EXPECT_EQ(hit.triangle, kNone);
  EXPECT_TRUE(tracer.unfinished() == 0 || (context().limits().isCpu && tracer.unfinished() == rays.size()))
      << tracer.unfinished();
}

TEST_F(TraverseTest, MissesEverythingInAnEmptyScene) {
  RayTracer tracer(context(), buildBvh({}, {}));
  const Hit hit = tracer.closestHits(std::vector<Ray>{{vec3(1), kInfinity, vec3(0, 1, 0), 0}})[0];
  EXPECT_EQ(hit.triangle, kNone);
}

TEST_F(TraverseTest, MeetsRaysThatAreNotNumbersWithoutHanging) {
  const Mesh mesh = randomTriangles(1000, 0.2f, 33);
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Ray> rays{{vec3(nan), kInfinity, vec3(0, 0, 1), 0},
                              {vec3(0.5f), kInfinity, vec3(nan), 0},
                              {vec3(0.5f), nan, vec3(0, 0, 1), 0},
                              {vec3(0.5f), kInfinity, vec3(0), 0},
                              {vec3(kInfinity), kInfinity, vec3(0, 1, 0), 0}};
  for (const Hit& hit : tracer.closestHits(rays)) EXPECT_EQ(hit.triangle, kNone);
}

}  // namespace importon::test
