// The hashed grid (render/lists/point_grid.h, lib/grid_search.glsl) against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "method/list_stage.h"
#include "support/stability.h"
#include "test_kernels/grid_key.h"
#include "test_kernels/grid_search.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

/// As in tests/kernels/grid_key.comp: a point with its own radius, or a search.
struct RadiusPoint {
  vec3 position;
  float radius;
  vec3 normal;
};

/// What a search met: indices of points, at most kKept of them, and its number of ranges.
struct Found {
  uint count = 0, ranges = 0;
  std::vector<uint> indices;
};

constexpr float kExtent = 8.0f;
constexpr uint kKept = 1000;
constexpr uint kMostRanges = 88;  // kMaxRanges of lib/grid_search.glsl: at this number some may be missing

class Grid : public test::ListTest {
 protected:
  void SetUp() override {
    ListTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    Parameters parameters{};
    parameters.gridOrigin = vec3(-0.5f * kExtent);
    parameters.gridExtent = kExtent;
    work().parameters.upload(std::span<const Parameters>(&parameters, 1));
  }

  /// A grid of `points`, with `slots` slots if not 0.
  PointGrid build(const std::vector<RadiusPoint>& points, std::uint64_t slots = 0) {
    PointGrid grid(context(), "grid under test", points.size());
    if (slots != 0) {
      grid.cells = gpu::Buffer(context(), "few cells", slots * sizeof(uvec2), gpu::TexelFormat::uint2);
      grid.slotMask = static_cast<uint>(slots - 1);
    }
    const gpu::Buffer input = gpu::makeBuffer(context(), "points", std::span<const RadiusPoint>(points));
    const gpu::Buffer mapPoints(context(), "map points", points.size() * sizeof(MapPoint), gpu::TexelFormat::uint4);
    setEntries(points.size());
    run<test_kernels::GridKey>(stage(), points.size(), {static_cast<uint>(points.size()), grid.slotMask},
                               test_kernels::buffers::In{input}, test_kernels::buffers::Out{mapPoints},
                               test_kernels::buffers::Keys{work().keysA});
    buildGrid(stage(), grid, kCounterEntries, mapPoints);
    stage().recorder.submitAndWait();
    return grid;
  }

  std::vector<Found> search(const PointGrid& grid, const std::vector<RadiusPoint>& searches) {
    const gpu::Buffer input = gpu::makeBuffer(context(), "searches", std::span<const RadiusPoint>(searches));
    const gpu::Buffer output(context(), "found", searches.size() * (kKept + 2) * sizeof(uint));
    run<test_kernels::GridSearch>(stage(), searches.size(), {static_cast<uint>(searches.size()), kKept},
                                  test_kernels::buffers::In{input}, test_kernels::buffers::Out{output},
                                  SearchedGrid(grid));
    stage().recorder.submitAndWait();
    const std::vector<uint> raw = test::numbers(output, searches.size() * (kKept + 2));
    std::vector<Found> all;
    for (std::size_t i = 0; i < searches.size(); ++i) {
      const auto begin = raw.begin() + static_cast<std::ptrdiff_t>(i * (kKept + 2));
      all.push_back({begin[0], begin[1], {begin + 2, begin + 2 + std::min(begin[0], kKept)}});
    }
    return all;
  }

  /// Every point that lies within the search and has a radius within a factor of two of its radius is met once;
  /// nothing outside is met. Returns how many points were met in all.
  std::size_t expectAsByBruteForce(const std::vector<RadiusPoint>& points, const std::vector<RadiusPoint>& searches,
                                   std::uint64_t slots = 0) {
    const std::vector<Found> all = search(build(points, slots), searches);
    std::size_t met = 0;
    for (std::size_t i = 0; i < searches.size(); ++i) {
      expectOne(points, searches[i], all[i]);
      if (HasFatalFailure()) return met;
      met += all[i].count;
    }
    return met;
  }

 private:
  static void expectOne(const std::vector<RadiusPoint>& points, const RadiusPoint& s, const Found& found) {
    ASSERT_LE(found.count, kKept) << "the test keeps too few";
    ASSERT_LT(found.ranges, kMostRanges);
    const std::set<uint> met(found.indices.begin(), found.indices.end());
    ASSERT_EQ(met.size(), found.indices.size()) << "a point was met twice";
    constexpr double kSlack = 1e-4;  // of the radius: the device's rounding decides there
    for (uint i = 0; i < points.size(); ++i) {
      const glm::dvec3 offset = glm::dvec3(points[i].position) - glm::dvec3(s.position);
      const double r = s.radius;
      const double across = std::abs(glm::dot(offset, glm::dvec3(s.normal)));
      const double excess = std::max(glm::length(offset) / r - 1, across / r - 0.25);
      const double ratio = points[i].radius / s.radius;
      const bool isOfLikeRadius = ratio > 0.5001 && ratio < 1.9999;
      if (excess < -kSlack && isOfLikeRadius) {
        ASSERT_TRUE(met.contains(i)) << "missed a point of ratio " << ratio;
      }
      if (excess > kSlack) {
        ASSERT_FALSE(met.contains(i)) << "met a point outside";
      }
    }
  }
};

vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

vec3 randomPosition(std::mt19937& random, float halfSide) {
  std::uniform_real_distribution<float> side(-halfSide, halfSide);
  return {side(random), side(random), side(random)};
}

float randomRadius(std::mt19937& random, double least, double most) {
  std::uniform_real_distribution<double> exponent(std::log(least), std::log(most));
  return static_cast<float>(std::exp(exponent(random)));
}

/// Clusters whose size goes with the radius of their points, so that searches of all radii meet some; densities
/// go as the inverse square of the radii.
std::vector<RadiusPoint> clusters(std::size_t count, std::size_t each, double least, double most, uint seed) {
  std::mt19937 random(seed);
  std::vector<RadiusPoint> points;
  for (std::size_t c = 0; c < count; ++c) {
    const vec3 centre = randomPosition(random, 0.4f * kExtent);
    const float radius = randomRadius(random, least, most);
    for (std::size_t k = 0; k < each; ++k) {
      const float own = radius * randomRadius(random, 0.4, 2.5);
      points.push_back({centre + 2.5f * radius * randomPosition(random, 1), own, randomDirection(random)});
    }
  }
  return points;
}

/// Searches at some of the points, with normals of their own and radii near those of the points.
std::vector<RadiusPoint> searchesNear(const std::vector<RadiusPoint>& points, std::size_t count, uint seed) {
  std::mt19937 random(seed);
  std::vector<RadiusPoint> searches;
  for (std::size_t i = 0; i < count; ++i) {
    RadiusPoint s = points[random() % points.size()];
    s.position += s.radius * randomPosition(random, 0.5f);
    s.radius *= randomRadius(random, 0.5, 2);
    s.normal = i % 4 == 0 ? vec3(i % 8 == 0, i % 8 == 4, 0) : randomDirection(random);
    searches.push_back(s);
  }
  return searches;
}

TEST_F(Grid, FindsAllPointsWithinRadiusOverSixOrdersOfMagnitudeOfDensity) {
  const auto points = clusters(200, 200, 1e-3, 1, 1);  // radii over three orders: densities over six
  EXPECT_GT(expectAsByBruteForce(points, searchesNear(points, 1000, 2)), 5000u);
}

TEST_F(Grid, FindsAllPointsInDenseUniformPoints) {
  std::mt19937 random(3);
  std::vector<RadiusPoint> points;
  for (int i = 0; i < 30'000; ++i)
    points.push_back({randomPosition(random, 1), randomRadius(random, 0.08, 0.3), vec3(0, 0, 1)});
  EXPECT_GT(expectAsByBruteForce(points, searchesNear(points, 400, 4)), 5000u);
}

TEST_F(Grid, CountsNothingTwiceWhereAllCellsCollide) {
  test::StabilityCase listed(31, "the hash table forced to one slot", "no double counting");
  const auto points = clusters(100, 100, 1e-2, 1, 5);
  EXPECT_GT(expectAsByBruteForce(points, searchesNear(points, 300, 6), 64), 1000u);
  listed.note("equal to brute force", 1);
}

TEST_F(Grid, HoldsAtTheFinestAndTheCoarsestLevel) {
  for (const double radius : {kExtent * 0x1p-21, kExtent * 0.25}) {
    const auto points = clusters(20, 100, radius, radius * 1.0001, 7);
    auto searches = searchesNear(points, 200, 8);
    for (RadiusPoint& s : searches) s.radius = static_cast<float>(radius);
    EXPECT_GT(expectAsByBruteForce(points, searches), 100u) << radius;
  }
}

TEST_F(Grid, CountsSixtyThousandPointsInOnePlaceEachOnce) {
  // Lavapipe of Mesa 22.3 ends all loops of an invocation after 65,535 rounds together.
  const std::vector<RadiusPoint> points(60'000, {vec3(0.3f, -0.7f, 1.1f), 0.05f, vec3(0, 0, 1)});
  const std::vector<RadiusPoint> searches(8, {vec3(0.31f, -0.7f, 1.1f), 0.05f, vec3(0, 0, 1)});
  for (const std::uint64_t slots : {0, 64})
    for (const Found& found : search(build(points, slots), searches)) EXPECT_EQ(found.count, points.size());
}

TEST_F(Grid, FindsNothingWherePointsAreFarAway) {
  const auto points = clusters(1, 1000, 0.01, 0.011, 9);
  RadiusPoint away{-points.front().position, 0.01f, vec3(0, 1, 0)};
  for (const Found& found : search(build(points, 64), {away})) EXPECT_EQ(found.count, 0u);
}

/// As in tests/kernels/search_radius.comp.
struct Wish {
  float photons, density, extent;
};
struct Radius {
  float radius;
  uint level;
  float edge;
};

class SearchRadius : public test::GpuTest {};

TEST_F(SearchRadius, StaysWithinWhatTheGridSearchesForAnyDensity) {
  test::StabilityCase listed(34, "lookup radii for densities 0 to infinity", "finite, within the grid");
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<Wish> wishes;
  for (const float density : {0.0f, 1e-38f, 1e-30f, 1e-6f, 1.0f, 1e6f, 1e15f, 1e30f, 3e38f, kInf})
    for (const float extent : {1e-6f, 1.0f, 4096.0f, 1e9f}) wishes.push_back({32, density, extent});
  const auto radii = test::runKernel<Radius>(context(), test_kernels::code("search_radius"), wishes);
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const auto& [photons, density, extent] = wishes[i];
    EXPECT_GE(radii[i].radius, extent * 0x1p-21f * 0.999f) << density;
    EXPECT_LE(radii[i].radius, extent * 0.2501f) << density;
    EXPECT_LE(radii[i].level, 20u);
    EXPECT_GE(radii[i].edge, 1.333f * radii[i].radius) << "cells of that level are too small";
    if (radii[i].level < 20) {
      EXPECT_LE(radii[i].edge, 2.667f * radii[i].radius) << "a finer level would do";
    }
  }
  listed.note("within", 1);
}

TEST_F(SearchRadius, HoldsThePhotonsAtTheDensity) {
  const std::vector<Wish> wishes{{32, 1000, 1}, {8, 1000, 1}, {8, 1e5f, 16}};
  const auto radii = test::runKernel<Radius>(context(), test_kernels::code("search_radius"), wishes);
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const double held =
        M_PI * std::pow(static_cast<double>(radii[i].radius), 2) * static_cast<double>(wishes[i].density);
    EXPECT_NEAR(held / static_cast<double>(wishes[i].photons), 1, 1e-5);
  }
}

}  // namespace
}  // namespace importon
