// Meshes that stand in many places: which are held once, and what their pages say.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "loader/load.h"
#include "scene/geometry.h"

namespace importon::test {
namespace {

constexpr KeepRule kKeepAll{.leastSaved = 1};

/// A wavy sheet of 2·cells² triangles over the unit square.
MeshPart sheet(uint cells) {
  MeshPart part;
  for (uint i = 0; i <= cells; ++i)
    for (uint j = 0; j <= cells; ++j) {
      const vec2 at = vec2(i, j) / static_cast<float>(cells);
      part.positions.emplace_back(at.x, 0.1f * std::sin(9 * at.x + 5 * at.y), at.y);
    }
  for (uint i = 0; i < cells; ++i)
    for (uint j = 0; j < cells; ++j) {
      const uint a = i * (cells + 1) + j, b = a + cells + 1;
      part.triangles.emplace_back(a, a + 1, b);
      part.triangles.emplace_back(b, a + 1, b + 1);
    }
  return part;
}

Scene assembled(const std::vector<MeshInstance>& instances, const KeepRule& rule) {
  Scene scene;
  Log log(Log::Verbosity::quiet);
  assembleGeometry(instances, scene, "test", log, rule);
  return scene;
}

glm::dmat4 moved(double x) { return glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0, 0)); }

TEST(PlacedMeshes, AreHeldOnceWhereFlatteningWouldRepeatEnough) {
  const MeshPart part = sheet(4);  // 32 triangles
  std::vector<MeshInstance> instances;
  for (int i = 0; i < 5; ++i) instances.push_back({&part, moved(2 * i)});
  const Scene placed = assembled(instances, {.leastSaved = 4 * 32});
  EXPECT_EQ(placed.worldTriangleCount(), 0u);
  EXPECT_EQ(placed.triangles.size(), 32u);
  EXPECT_EQ(placed.placed.instances.size(), 5u);
  EXPECT_EQ(placed.shownTriangleCount(), 5 * 32u);
  const Scene flat = assembled(instances, {.leastSaved = 4 * 32 + 1});
  EXPECT_TRUE(flat.placed.isEmpty());
  EXPECT_EQ(flat.triangles.size(), 5 * 32u);
  EXPECT_NEAR(glm::length(placed.boundsMin - flat.boundsMin) + glm::length(placed.boundsMax - flat.boundsMax), 0, 1e-5);
}

TEST(PlacedMeshes, WhatEmitsOrIsPressedFlatIsFlattened) {
  const MeshPart part = sheet(4);
  std::vector<MeshInstance> instances{{&part, moved(0)}, {&part, moved(1)}, {&part, moved(2)}};
  instances.push_back({&part, glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1))});
  instances.push_back({&part, moved(9), 0, true});
  const Scene scene = assembled(instances, kKeepAll);
  EXPECT_EQ(scene.placed.instances.size(), 3u);
  EXPECT_GE(scene.worldTriangleCount(), 32u);
}

TEST(PlacedMeshes, HaveTheirTrianglesInPagesThatLieTogether) {
  const MeshPart part = sheet(64);  // 8192 triangles
  const Scene scene = assembled({{&part, moved(0)}, {&part, moved(3)}}, kKeepAll);
  const PlacedMesh& mesh = scene.placed.meshes.front();
  ASSERT_EQ(mesh.pages.size(), 8u);
  double area = 0;
  for (std::size_t page = 0; page < mesh.pages.size(); ++page) {
    const MeshPage& each = mesh.pages[page];
    for (std::size_t i = 0; i < kPageTriangles; ++i) {
      const Triangle& t = scene.triangles[mesh.firstTriangle + page * kPageTriangles + i];
      for (const uint corner : {t.v0, t.v1, t.v2})
        EXPECT_TRUE(glm::all(glm::lessThanEqual(each.low, scene.positions[corner])) &&
                    glm::all(glm::greaterThanEqual(each.high, scene.positions[corner])));
    }
    const vec3 sides = each.high - each.low;
    EXPECT_LT(sides.x * sides.z, 0.35f);  // an eighth of the square, with what a curve leaves of it
    area += each.areas.area();
  }
  double expected = 0;
  for (const Triangle& t : scene.triangles)
    expected += 0.5 * static_cast<double>(glm::length(glm::cross(scene.positions[t.v1] - scene.positions[t.v0],
                                                                 scene.positions[t.v2] - scene.positions[t.v0])));
  EXPECT_NEAR(area / expected, 1, 1e-5);
}

TEST(PlacedMeshes, PagesOfAllInstancesAreCountedTogether) {
  const MeshPart large = sheet(64), small = sheet(4);
  const Scene scene =
      assembled({{&small, moved(0)}, {&large, moved(0)}, {&small, moved(5)}, {&large, moved(7)}}, kKeepAll);
  uint next = 0;
  for (const PlacedInstance& instance : scene.placed.instances) {
    EXPECT_EQ(instance.firstPage, next);
    next += static_cast<uint>(scene.placed.meshes[instance.mesh].pages.size());
  }
  EXPECT_EQ(scene.placed.pageCount(), next);
}

TEST(AreaTensor, TellsTheAreaOfParallelTrianglesAfterAnyMap) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 a = vector(), b = vector(), c = vector();
    const Placement map{glm::dmat3(vector(), vector(), vector()), glm::dvec3(0.0)};
    AreaTensor tensor;
    tensor.add(a, b, c);
    tensor.add(a, b, a + (b - a) * 0.5 + (c - a) * 2.0);  // in the same plane
    const double area = 0.5 * glm::length(glm::cross(map.linear * (b - a), map.linear * (c - a)));
    EXPECT_NEAR(tensor.areaAfter(map.cofactors()) / (3 * area), 1, 1e-4);
  }
}

TEST(AreaTensor, TellsTheAreaOfASurfaceAfterAMapOfOneScale) {
  const MeshPart part = sheet(8);
  const Scene scene = assembled({{&part, moved(0)}, {&part, moved(2)}}, kKeepAll);
  const AreaTensor& areas = scene.placed.meshes.front().pages.front().areas;
  const Placement map{glm::dmat3(glm::rotate(glm::dmat4(1.0), 1.2, glm::dvec3(1, 2, 3))) * 3.0, glm::dvec3(1.0)};
  EXPECT_NEAR(areas.areaAfter(map.cofactors()) / (9 * areas.area()), 1, 1e-6);
}

TEST(Placement, BoxesHoldWhatIsPlaced) {
  const Placement map{glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 3))), glm::dvec3(4, 5, 6)};
  glm::dvec3 low(1e9), high(-1e9);
  map.includeBox(vec3(-1, 0, 1), vec3(1, 2, 2), low, high);
  for (uint corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at = map(vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 2 : 0, (corner & 4) != 0 ? 2 : 1));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(low - 1e-9, at)) && glm::all(glm::greaterThanEqual(high + 1e-9, at)));
  }
}

TEST(PlacedMeshes, OfAFileAreThoseThatNodesRepeat) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltfFromMemory(asBytes(builder.glb()), "test.glb", {}, log, {.keep = {.leastSaved = 0}});
  EXPECT_TRUE(scene.placed.isEmpty());  // it emits, and has few triangles
}

}  // namespace
}  // namespace importon::test
