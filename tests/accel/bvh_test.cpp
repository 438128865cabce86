#include "accel/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "accel/encode.h"
#include "accel/meshes.h"

namespace importon::test {
namespace {

/// What a walk over all records finds.
struct Walk {
  std::vector<std::uint32_t> timesInLeaf;  // by triangle
  std::size_t recordsSeen = 0;
  std::uint32_t depth = 0;    // nodes on the longest path
  std::size_t uncovered = 0;  // children that stick out of the box of their slot
};

class Walker {
 public:
  Walker(const Bvh& bvh, std::size_t triangles) : bvh_(bvh) { walk_.timesInLeaf.assign(triangles, 0); }

  Walk walk() {
    (void)visitNode(0, 1);
    return walk_;
  }

 private:
  /// The exact bounds of all triangles below.
  Box visitNode(std::uint32_t index, std::uint32_t depth) {
    ++walk_.recordsSeen;
    walk_.depth = std::max(walk_.depth, depth);
    const BvhNode node = asNode(bvh_.nodes.at(index));
    Box whole = Box::empty();
    for (std::uint32_t slot = 0; slot < kBvhWidth; ++slot) {
      if (!hasChild(node, slot)) continue;
      const std::uint32_t child = node.firstChild + slot;
      const Box exact = isLeaf(bvh_.nodes.at(child)) ? visitLeaf(child) : visitNode(child, depth + 1);
      const Box seen = childBox(node, slot);
      for (int axis = 0; axis < 3; ++axis)
        if (seen.lo[axis] > exact.lo[axis] || seen.hi[axis] < exact.hi[axis]) ++walk_.uncovered;
      whole.include(exact);
    }
    return whole;
  }

  Box visitLeaf(std::uint32_t index) {
    Box box = Box::empty();
    do {
      ++walk_.recordsSeen;
      const BvhTriangle record = asTriangle(bvh_.nodes.at(index));
      ++walk_.timesInLeaf.at(record.triangle);
      for (const vec3& v : {record.v0, record.v1, record.v2}) box.include(toFloat4(v));
      index = record.next;
    } while (index != 0);
    return box;
  }

  const Bvh& bvh_;
  Walk walk_;
};

Walk walk(const Bvh& bvh, std::size_t triangles) { return Walker(bvh, triangles).walk(); }

/// Of whole triangles; see split_triangles_test.cpp for parts.
void expectSound(const Mesh& mesh) {
  const Bvh bvh = buildBvh(mesh.positions, mesh.triangles, {.threads = 0, .progress = {}, .splits = false});
  const Walk found = walk(bvh, mesh.triangles.size());
  EXPECT_TRUE(std::all_of(found.timesInLeaf.begin(), found.timesInLeaf.end(), [](auto n) { return n == 1; }));
  EXPECT_EQ(found.recordsSeen, bvh.nodes.size());
  EXPECT_EQ(found.uncovered, 0u);
  EXPECT_LE(found.depth, kBvhMaxDepth);
}

/// Sizes and distances over many powers of two: splits that peel off one triangle at a time.
Mesh shrinkingTriangles(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const float s = std::ldexp(1.0f, -i);
    mesh.add({s, 0, 0}, {s * 1.5f, 0, 0}, {s, s * 0.5f, 0});
  }
  return mesh;
}

bool sameBytes(const Bvh& a, const Bvh& b) {
  return a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhRecord)) == 0;
}

}  // namespace

TEST(Bvh, HoldsEachTriangleOnceInBoxesThatContainIt) {
  for (const std::size_t count : {1u, 2u, 3u, 5u, 100u, 5000u}) expectSound(randomTriangles(count, 0.05f, 1));
  expectSound(heightField(100));
  expectSound(closedBox(vec3(-1), vec3(1)));
}

TEST(Bvh, HoldsLargeScenesWorkedOnInParallel) { expectSound(heightField(300)); }

TEST(Bvh, KeepsItsDepthWithinTheStackForExtremeScenes) {
  expectSound(shrinkingTriangles(120));
  Mesh mesh = shrinkingTriangles(100);
  const Mesh rest = randomTriangles(20000, 1e-3f, 2);
  for (std::size_t t = 0; t < rest.triangles.size(); ++t)
    mesh.add(rest.vertex(t, 0) * 1e-6f, rest.vertex(t, 1) * 1e-6f, rest.vertex(t, 2) * 1e-6f);
  expectSound(mesh);
}

TEST(Bvh, IsSoundFarFromTheOriginAndForFlatScenes) {
  Mesh far = heightField(20);
  for (vec3& p : far.positions) p += vec3(1e6f, -3e7f, 5e4f);
  std::erase_if(far.triangles, [&](const Triangle& t) {
    const vec3 a = far.positions[t.v0], b = far.positions[t.v1], c = far.positions[t.v2];
    return glm::length(glm::cross(b - a, c - a)) == 0.0f;
  });
  far.add(vec3(1e6f, -3e7f, 5e4f), vec3(2e6f, -3e7f, 5e4f), vec3(1e6f, -2e7f, 5e4f));
  expectSound(far);
  Mesh flat = heightField(30);
  for (vec3& p : flat.positions) p.z = 0.125f;
  expectSound(flat);
}

TEST(Bvh, IsTheSameBytesForAnyNumberOfThreads) {
  const Mesh mesh = heightField(250);
  const Bvh one = buildBvh(mesh.positions, mesh.triangles, {.threads = 1, .progress = {}});
  for (const int threads : {0, 2, 5})
    EXPECT_TRUE(sameBytes(one, buildBvh(mesh.positions, mesh.triangles, {.threads = threads, .progress = {}})));
}

TEST(Bvh, IsTheSameTreeForASceneScaledByAPowerOfTwo) {
  Mesh mesh = randomTriangles(3000, 0.1f, 3);
  const Bvh before = buildBvh(mesh.positions, mesh.triangles);
  for (vec3& p : mesh.positions) p *= 0x1p-13f;
  const Bvh after = buildBvh(mesh.positions, mesh.triangles);
  ASSERT_EQ(before.nodes.size(), after.nodes.size());
  for (std::size_t i = 0; i < before.nodes.size(); ++i) {
    ASSERT_EQ(isLeaf(before.nodes[i]), isLeaf(after.nodes[i]));
    if (isLeaf(before.nodes[i])) {
      EXPECT_EQ(asTriangle(before.nodes[i]).triangle, asTriangle(after.nodes[i]).triangle);
    } else {
      EXPECT_EQ(asNode(before.nodes[i]).lowX, asNode(after.nodes[i]).lowX);
      EXPECT_EQ(asNode(before.nodes[i]).highZ, asNode(after.nodes[i]).highZ);
    }
  }
}

TEST(Bvh, ReportsRisingProgressFromTheCallingThreadUpToOne) {
  const Mesh mesh = heightField(200);
  std::vector<double> reports;
  const auto caller = std::this_thread::get_id();
  (void)buildBvh(mesh.positions, mesh.triangles, {.threads = 0, .progress = [&](double fraction) {
                                                    EXPECT_EQ(std::this_thread::get_id(), caller);
                                                    reports.push_back(fraction);
                                                  }});
  ASSERT_GT(reports.size(), 2u);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_GT(reports.front(), 0.0);
  EXPECT_EQ(reports.back(), 1.0);
}

TEST(Bvh, KeepsOneOfAHundredThousandIdenticalTriangles) {
  Mesh mesh = randomTriangles(50, 0.1f, 4);
  for (int i = 0; i < 100000; ++i) mesh.triangles.push_back(mesh.triangles[7]);
  const Bvh bvh = buildBvh(mesh.positions, mesh.triangles);
  const Walk found = walk(bvh, mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) EXPECT_EQ(found.timesInLeaf[i], i < 50 ? 1u : 0u);
}

TEST(Bvh, KeepsAFewCoincidentTriangles) {
  Mesh mesh = randomTriangles(50, 0.1f, 5);
  for (int i = 0; i < 30; ++i) mesh.triangles.push_back(mesh.triangles[7]);
  expectSound(mesh);
}

TEST(Bvh, TakesAMillionTrianglesWithinEightyBytesEach) {
  const Mesh mesh = heightField(708);
  ASSERT_GE(mesh.triangles.size(), 1000000u);
  const Bvh bvh = buildBvh(mesh.positions, mesh.triangles);
  EXPECT_LE(bvh.nodes.size() * sizeof(BvhRecord), 80 * mesh.triangles.size());
}

TEST(Bvh, OfNothingIsANodeWithoutChildren) {
  const Bvh bvh = buildBvh({}, {});
  ASSERT_EQ(bvh.nodes.size(), 1u);
  for (std::uint32_t slot = 0; slot < kBvhWidth; ++slot) EXPECT_FALSE(hasChild(asNode(bvh.nodes[0]), slot));
}

}  // namespace importon::test
