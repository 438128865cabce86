#include "accel/split_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "accel/build_tree.h"
#include "accel/bvh.h"
#include "accel/encode.h"

namespace importon::test {
namespace {

LargeVector<PrimitiveBox> split(const Mesh& mesh, const SplitOptions& options = {}) {
  return splitTriangles(boxesOf(mesh), mesh.positions, mesh.triangles, options);
}

double areaOf(const LargeVector<PrimitiveBox>& boxes) {
  double area = 0;
  for (const Box& box : boxes) area += static_cast<double>(box.halfArea());
  return area;
}

bool holds(const Box& box, const glm::dvec3& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < static_cast<double>(box.lo[axis]) || point[axis] > static_cast<double>(box.hi[axis]))
      return false;
  return true;
}

/// Corners, points on edges and points within.
std::vector<glm::dvec3> pointsOf(const Mesh& mesh, std::size_t triangle) {
  std::mt19937 engine(static_cast<std::uint32_t>(triangle));
  const auto unit = [&] { return static_cast<double>(engine() >> 8) * 0x1p-24; };
  const glm::dvec3 a(mesh.vertex(triangle, 0)), b(mesh.vertex(triangle, 1)), c(mesh.vertex(triangle, 2));
  std::vector<glm::dvec3> points{a, b, c};
  for (int i = 0; i < 20; ++i) {
    const double r = i < 10 ? 1.0 : std::sqrt(unit()), s = unit();
    points.push_back(a + (b - a) * (r * (1 - s)) + (c - a) * (r * s));
  }
  return points;
}

/// Whether the boxes that hold a point, from the root on, lead to the triangle.
bool leadsTo(const Bvh& bvh, std::uint32_t index, const glm::dvec3& point, std::uint32_t triangle) {
  if (isLeaf(bvh.nodes.at(index))) {
    for (;; index = asTriangle(bvh.nodes.at(index)).next) {
      if (asTriangle(bvh.nodes.at(index)).triangle == triangle) return true;
      if (asTriangle(bvh.nodes.at(index)).next == 0) return false;
    }
  }
  const BvhNode node = asNode(bvh.nodes[index]);
  for (std::uint32_t slot = 0; slot < kBvhWidth; ++slot)
    if (hasChild(node, slot) && holds(childBox(node, slot), point) &&
        leadsTo(bvh, node.firstChild + slot, point, triangle))
      return true;
  return false;
}

}  // namespace

TEST(SplitTriangles, PartsTogetherHoldEveryPointOfTheTriangle) {
  const Mesh mesh = slats(300, 51);
  const LargeVector<PrimitiveBox> parts = split(mesh, {.mostParts = 100.0f});
  EXPECT_GT(parts.size(), mesh.triangles.size() + 1000);
  EXPECT_LT(areaOf(parts), 0.5 * areaOf(boxesOf(mesh)));
  std::vector<std::vector<Box>> byTriangle(mesh.triangles.size());
  for (const PrimitiveBox& part : parts) byTriangle.at(primitiveIndex(part)).push_back(part);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const glm::dvec3& point : pointsOf(mesh, t))
      ASSERT_TRUE(std::any_of(byTriangle[t].begin(), byTriangle[t].end(), [&](const Box& b) {
        return holds(b, point);
      })) << t;
}

TEST(SplitTriangles, LeavesTrianglesWholeWhereLittleIsSaved) {
  for (const Mesh& mesh : {heightField(50), closedBox(vec3(-1), vec3(1))})
    EXPECT_EQ(split(mesh).size(), mesh.triangles.size());
}

TEST(SplitTriangles, KeepsToTheNumberOfPartsThatItMayMake) {
  const Mesh mesh = slats(400, 52);
  const std::size_t all = split(mesh, {.mostParts = 100.0f}).size();
  for (const float most : {0.1f, 0.2f}) {
    const LargeVector<PrimitiveBox> parts = split(mesh, {.leastGainInAll = 0.0f, .mostParts = most});
    EXPECT_EQ(parts.size(),
              mesh.triangles.size() + static_cast<std::size_t>(most * static_cast<float>(mesh.triangles.size())));
    EXPECT_LT(parts.size(), all);
  }
}

TEST(SplitTriangles, LeavesTrianglesWholeWhereTooManyWouldHaveToBeCut) {
  Mesh mesh = slats(400, 55);
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 4000);  // the tiny ones
  EXPECT_EQ(split(mesh).size(), 400u);
}

TEST(SplitTriangles, LeavesThoseWholeThatMustStandInOneLeaf) {
  const Mesh mesh = slats(300, 56);
  const auto isEven = [&](const Triangle& t) { return (&t - mesh.triangles.data()) % 2 == 0; };
  BvhOptions options;
  options.staysWhole = isEven;
  const Bvh bvh = buildBvh(mesh.positions, mesh.triangles, options);
  std::vector<int> leaves(mesh.triangles.size());
  for (const BvhRecord& record : bvh.nodes)
    if (isLeaf(record)) ++leaves[asTriangle(record).triangle];
  int cut = 0;
  for (std::size_t t = 0; t < leaves.size(); ++t) {
    if (t % 2 == 0) {
      ASSERT_EQ(leaves[t], 1) << t;
    }
    cut += leaves[t] > 1 ? 1 : 0;
  }
  EXPECT_GT(cut, 100);
}

TEST(SplitTriangles, TreeLeadsToTheTriangleOfEveryPoint) {
  const Mesh mesh = slats(300, 53);
  const Bvh bvh = buildBvh(mesh.positions, mesh.triangles);
  EXPECT_GT(std::count_if(bvh.nodes.begin(), bvh.nodes.end(), isLeaf), std::ssize(mesh.triangles));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const glm::dvec3& point : pointsOf(mesh, t)) ASSERT_TRUE(leadsTo(bvh, 0, point, t)) << t;
}

TEST(SplitTriangles, TreeIsTheSameBytesForAnyNumberOfThreads) {
  const Mesh mesh = slats(2000, 54);
  const Bvh one = buildBvh(mesh.positions, mesh.triangles, {.threads = 1, .progress = {}});
  EXPECT_GT(std::count_if(one.nodes.begin(), one.nodes.end(), isLeaf), std::ssize(mesh.triangles));
  for (const int threads : {2, 5}) {
    const Bvh other = buildBvh(mesh.positions, mesh.triangles, {.threads = threads, .progress = {}});
    ASSERT_EQ(other.nodes.size(), one.nodes.size());
    EXPECT_EQ(std::memcmp(other.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof(BvhRecord)), 0);
  }
}

}  // namespace importon::test
