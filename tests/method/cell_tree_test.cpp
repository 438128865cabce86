// Groups of surface cells, and irradiance averaged over them as far as it does not differ.
#include "render/surface_cache/cell_tree.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "kernels/cell_group.h"
#include "kernels/cell_smooth.h"
#include "shared/render_data.h"
#include "support/gpu_test.h"
#include "support/statistics.h"

namespace importon {
namespace {

using gpu::TexelFormat;

/// Triangles of n² cells each, of `area` m² each cell.
SurfaceCells gridsOf(const std::vector<uint>& parts, float area) {
  SurfaceCells cells;
  for (const uint n : parts) {
    cells.triangles.push_back({cells.areas.size(), n});
    cells.areas.resize(cells.areas.size() + n * n, area);
  }
  return cells;
}

TEST(CellTree, HasEachCellOfADividedTriangleInOneGroupOfEachLevel) {
  const SurfaceCells cells = gridsOf({1, 2, 3, 4, 5, 8, 31}, 0.5f);
  const CellTree tree = growCellTree(cells);
  const uint count = static_cast<uint>(cells.areas.size());
  std::vector<uint> found(count + tree.groups.size());
  for (uint g = 0; g < tree.groups.size(); ++g) {
    float area = 0;
    for (uint k = tree.groups[g].x; k < tree.groups[g].y; ++k) {
      const uint node = tree.members[k];
      ++found[node];
      EXPECT_EQ(node < count ? tree.cells[node].x : tree.groups[node - count].z, g);
      area += std::bit_cast<float>(node < count ? tree.cells[node].y : tree.groups[node - count].w);
    }
    EXPECT_FLOAT_EQ(area, std::bit_cast<float>(tree.groups[g].w));
  }
  for (uint cell = 0; cell < count; ++cell) EXPECT_EQ(found[cell], cell == 0 ? 0u : 1u) << cell;
  for (uint g = 0; g < tree.groups.size(); ++g) EXPECT_EQ(found[count + g], tree.groups[g].z == kNone ? 0u : 1u);
}

TEST(CellTree, HasMembersOfOneTriangleWithinFourSteps) {
  const SurfaceCells cells = gridsOf({9, 16}, 1);
  const CellTree tree = growCellTree(cells);
  const auto rowOf = [&](uint cell) {
    const auto [first, n] = std::pair(cells.triangles[cell < 81 ? 0 : 1].x, cells.triangles[cell < 81 ? 0 : 1].y);
    uint row = 0;
    while (first + (row + 1) * (2 * n - row - 1) <= cell) ++row;
    return row;
  };
  for (uint a = 0; a < cells.areas.size(); ++a) {
    const uint top = tree.groups[tree.cells[a].x].z;
    for (uint b = 0; b < cells.areas.size(); ++b)
      if (top != kNone && tree.groups[tree.cells[b].x].z == top) {
        EXPECT_EQ(a < 81, b < 81);
        EXPECT_EQ(rowOf(a) / 4, rowOf(b) / 4);
      }
  }
}

TEST(CellTree, OfNoCellsIsEmpty) {
  const CellTree tree = growCellTree({});
  EXPECT_TRUE(tree.groups.empty());
  EXPECT_TRUE(growCellTree(gridsOf({1, 1}, 1)).groups.empty());
}

/// What the photons of one side of all cells are: grey, of one strength.
struct Photons {
  std::vector<uint> counts;
  uint strength = 1000;  // units of flux
};

class CellSmoothing : public test::GpuTest {
 protected:
  /// Irradiance of the front side of each cell, photons per m², by the renderer's kernels.
  [[nodiscard]] std::vector<double> smooth(const SurfaceCells& cells, const Photons& photons) const {
    const CellTree tree = growCellTree(cells);
    const uint count = static_cast<uint>(cells.areas.size());
    std::vector<uint> sums(16 * count);
    constexpr uint kUnitsPerSquare = 16;
    for (uint i = 0; i < count; ++i) {
      for (uint c = 0; c < 3; ++c) sums[16 * i + 8 + 2 * c] = photons.counts[i] * photons.strength;
      sums[16 * i + 14] = photons.counts[i];
      sums[16 * i + 15] = kUnitsPerSquare * photons.counts[i];
    }
    Parameters parameters{};
    parameters.photonUnits = 4 / std::sqrt(3.0f) / static_cast<float>(photons.strength);  // three channels
    const auto make = [&](auto span, TexelFormat format) {
      return gpu::makeBuffer(context(), "of a test", span, format);
    };
    struct {
      gpu::Buffer parameters, counters, cellSums, cellGroups, cellMembers, cellPlaces, groupLight, cellIrradiances;
    } of{gpu::makeBuffer(context(), "parameters", std::span<const Parameters>(&parameters, 1)),
         gpu::Buffer(context(), "counters", kCounterCount * sizeof(uint)),
         make(std::span<const uint>(sums), TexelFormat::uint4),
         make(std::span<const uvec4>(tree.groups), TexelFormat::uint4),
         make(std::span<const uint>(tree.members), TexelFormat::uint1),
         make(std::span<const uvec2>(tree.cells), TexelFormat::uint2),
         make(std::span<const uvec4>(std::vector<uvec4>(4 * tree.groups.size())), TexelFormat::uint4),
         gpu::Buffer(context(), "irradiance", 2 * count * sizeof(vec4))};
    const gpu::Kernel group(context(), "groups", kernels::CellGroup::kCode);
    const gpu::Kernel finish(context(), "cells", kernels::CellSmooth::kCode);
    gpu::Recorder recorder(context());
    for (std::size_t level = 0; level + 1 < tree.levels.size(); ++level) {
      const uint groups = tree.levels[level + 1] - tree.levels[level];
      recorder.dispatch(group, kernels::CellGroup::buffers(of), 2 * groups,
                        kernels::CellGroup::Push{tree.levels[level], groups, count});
    }
    recorder.dispatch(finish, kernels::CellSmooth::buffers(of), 2 * count, kernels::CellSmooth::Push{count});
    recorder.submitAndWait();
    std::vector<double> irradiance;
    for (const vec4& v : of.cellIrradiances.download<vec4>(2 * count))
      irradiance.push_back(static_cast<double>(v.x) * std::sqrt(3.0) / 4);
    std::vector<double> front;
    for (uint i = 0; i < count; ++i) {
      EXPECT_EQ(irradiance[2 * i], 0);  // no photon came from behind
      front.push_back(irradiance[2 * i + 1]);
    }
    return front;
  }
};

TEST_F(CellSmoothing, OfAGroupFollowsTheFormulaOfJamesAndStein) {
  const SurfaceCells cells = gridsOf({2}, 0.25f);
  const Photons photons{{7, 12, 1, 8}};
  const double mean = 7, noise = mean, squares = 25 + 36 + 1;  // of counts: all cells are alike large
  const double share = 1 - (4 - 3) * noise / squares;
  const std::vector<double> found = smooth(cells, photons);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i] * 0.25, mean + share * (photons.counts[i] - mean), 1e-4) << i;
}

TEST_F(CellSmoothing, KeepsFluxAndWhatDiffersByFarMoreThanNoise) {
  const SurfaceCells cells = gridsOf({13}, 0.1f);
  Photons photons;
  double before = 0;
  for (uint i = 0; i < 169; ++i) before += photons.counts.emplace_back(i % 5 == 0 ? 20'000 : 0);
  const std::vector<double> found = smooth(cells, photons);
  double after = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    after += found[i] * 0.1;
    EXPECT_NEAR(found[i] * 0.1, photons.counts[i], 0.005 * 20'000) << i;
  }
  EXPECT_NEAR(after / before, 1, 1e-5);
}

/// James and Stein's estimate has less squared error than the cells themselves, whatever the light: much less where it
/// is even. Tests at a significance of 1e-3 over independent tries.
TEST_F(CellSmoothing, HasLessErrorThanCellsAlone) {
  const SurfaceCells cells = gridsOf({8}, 1);
  std::mt19937 random(5);
  for (const double unevenness : {0.0, 0.3, 2.0}) {
    test::Moments gain;  // squared error alone, less that of the estimate, of a try
    std::normal_distribution<double> normal(0, unevenness);
    for (int repeat = 0; repeat < 40; ++repeat) {
      Photons photons;
      std::vector<double> truth;
      for (uint i = 0; i < 64; ++i) {
        truth.push_back(6 * std::exp(normal(random)));
        photons.counts.push_back(std::poisson_distribution<uint>(truth.back())(random));
      }
      const std::vector<double> found = smooth(cells, photons);
      double alone = 0, shared = 0;
      for (std::size_t i = 0; i < 64; ++i) {
        alone += std::pow(photons.counts[i] - truth[i], 2);
        shared += std::pow(found[i] - truth[i], 2);
      }
      gain.add((alone - shared) / alone);
    }
    const double error = std::sqrt(gain.variance() / 40);
    if (unevenness < 1)
      EXPECT_GT(gain.mean() - 3.3 * error, unevenness == 0 ? 0.5 : 0.1);
    else
      EXPECT_GT(gain.mean() + 3.3 * error, -0.01);
  }
}

}  // namespace
}  // namespace importon
