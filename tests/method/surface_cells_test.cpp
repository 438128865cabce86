// Surface cells: they cover every surface once, with the area that they say, as densely as asked.
#include "render/surface_cache/surface_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "render/importance/point_density.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::surface_cells_test {
namespace {

/// As in tests/kernels/surface_cell.comp.
struct Query {
  vec2 uv;
  uint n;
};

class SurfaceCellsTest : public test::GpuTest {};

TEST_F(SurfaceCellsTest, OfATriangleAreAllAlikeLarge) {
  constexpr uint kParts[] = {1, 2, 5, 16};
  constexpr std::size_t kSamples = 100'000;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const uint n : kParts) {
    std::vector<Query> queries(kSamples);
    for (Query& q : queries) {
      q = {vec2(unit(random), unit(random)), n};
      if (q.uv.x + q.uv.y > 1) q.uv = 1.0f - q.uv;
    }
    std::vector<double> counts(n * n), expected(n * n, static_cast<double>(kSamples) / (n * n));
    for (const uint cell : test::runKernel<uint>(context(), test_kernels::code("surface_cell"), queries)) {
      ASSERT_LT(cell, n * n);
      ++counts[cell];
    }
    if (n > 1) {
      EXPECT_GT(test::chiSquareTest(counts, expected).pValue, 1e-4) << n;
    }
  }
}

TEST_F(SurfaceCellsTest, StayInTheTriangleAtItsCornersAndEdges) {
  std::vector<Query> queries;
  for (const uint n : {1u, 3u, 2047u})
    for (const vec2 uv : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(0.5f, 0.5f), vec2(1.000001f, 0),
                          vec2(0.3f, 0.7000001f), vec2(-1e-7f, 0.5f), vec2(NAN, 0)})
      queries.push_back({uv, n});
  const auto cells = test::runKernel<uint>(context(), test_kernels::code("surface_cell"), queries);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_LT(cells[i], queries[i].n * queries[i].n) << i;
}

/// A floor of two large triangles under a ball of many small ones.
Scene ballOverFloor() {
  test::SceneBuilder builder;
  const auto material = builder.material(test::diffuse(vec3(0.5f)));
  builder.square(material, {0, 0, 0}, {0, 1, 0}, 4);
  builder.icosphere(material, {0, 1, 0}, 0.5, 4, test::Facing::outside, test::Shading::flat);
  builder.pointLight({0, 2, 0}, vec3(1));
  builder.camera({0, 1, 3}, {0, 0, 0}, 0.8, 8, 8);
  return builder.finish();
}

double areaOf(const Scene& scene, std::size_t i) {
  const Triangle& t = scene.triangles[i];
  return 0.5 * static_cast<double>(glm::length(glm::cross(scene.positions[t.v1] - scene.positions[t.v0],
                                                          scene.positions[t.v2] - scene.positions[t.v0])));
}

TEST(SurfaceCells, CoverEverySurfaceOnce) {
  const Scene scene = ballOverFloor();
  for (const double density : {1.0, 40.0, 1e4}) {
    const SurfaceCells cells = cutSurfaces(
        scene, [&](vec3) { return density; }, 1u << 22, 0);
    std::vector<double> covered(cells.areas.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      const auto [first, n] = std::pair(cells.triangles[i].x, cells.triangles[i].y);
      for (uint k = 0; k < n * n; ++k) covered[first + k] += areaOf(scene, i) / (n * n);
    }
    for (std::size_t i = 0; i < covered.size(); ++i)
      EXPECT_NEAR(covered[i] / static_cast<double>(cells.areas[i]), 1, 1e-5);
  }
}

TEST(SurfaceCells, AreAsDenseAsAskedAndSmallTrianglesShareOne) {
  const Scene scene = ballOverFloor();
  constexpr double kDensity = 100;
  const SurfaceCells cells = cutSurfaces(
      scene, [](vec3) { return kDensity; }, 1u << 22, 0);
  const double perFloorTriangle = 8 * kDensity;
  const double n = static_cast<double>(cells.triangles[0].y);
  EXPECT_GE(n * n, perFloorTriangle);
  EXPECT_LT((n - 1) * (n - 1), perFloorTriangle);
  const double onBall = static_cast<double>(cells.areas.size()) - 2 * n * n;
  EXPECT_LT(onBall, 0.5 * static_cast<double>(scene.triangles.size()));
  EXPECT_GT(onBall, 0.5 * kDensity * M_PI);  // of the ball's area, pi
}

// A photon on a sliver of a cell would make it far too bright.
TEST(SurfaceCells, AreNotMuchSmallerThanAskedHoweverTrianglesMeetTheirGrid) {
  const Scene scene = ballOverFloor();
  for (const double density : {7.0, 30.0, 100.0, 300.0}) {
    const SurfaceCells cells = cutSurfaces(
        scene, [&](vec3) { return density; }, 1u << 22, 0);
    EXPECT_GT(static_cast<double>(*std::min_element(cells.areas.begin(), cells.areas.end())), 0.249 / density);
  }
}

TEST(SurfaceCells, AreNoMoreThanThereIsRoomFor) {
  const Scene scene = ballOverFloor();
  const SurfaceCells cells = cutSurfaces(
      scene, [](vec3) { return 1e6; }, 5000, 0);
  EXPECT_LE(cells.areas.size(), 5000u);
  EXPECT_GT(cells.areas.size(), 1000u);
}

TEST(SurfaceCells, AreAsSmallAsTheImportantPartOfATriangleAsks) {
  const Scene scene = ballOverFloor();
  const auto density = [](vec3 p) { return p.x < 0 && p.z < 0 ? 1000.0 : 1.0; };
  const SurfaceCells cells = cutSurfaces(scene, density, 1u << 22, 0);
  const uint n = std::max(cells.triangles[0].y, cells.triangles[1].y);
  EXPECT_GT(8.0 * 1000 / (n * n), 0.5);
  EXPECT_LT(8.0 * 1000 / (n * n), 1.5);
}

TEST(PointDensity, OfEvenPointsOnAPlaneIsTheirNumberPerArea) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<vec3> points;
  for (int i = 0; i < 100'000; ++i) points.emplace_back(unit(random), unit(random), 0.3f);
  const std::vector<float> weights(points.size(), 2.0f);
  const PointDensity density(points, weights, vec3(0), 1);
  double sum = 0;
  constexpr int kPlaces = 200;
  for (int i = 0; i < kPlaces; ++i) sum += density.at({unit(random), unit(random), 0.3f});
  // The smallest cube with enough points has some more than an average one: at most 10 % here (measured 3 %).
  EXPECT_NEAR(sum / kPlaces / 2e5, 1, 0.1);
  EXPECT_EQ(density.at({0.1f, 0.1f, 0.9f}), density.at({0.12f, 0.1f, 0.95f}));  // nothing near: the same coarse cube
}

TEST(PointDensity, WithoutPointsIsNone) { EXPECT_EQ(PointDensity({}, {}, vec3(0), 1).at(vec3(0.5f)), 0); }

}  // namespace
}  // namespace importon::surface_cells_test
