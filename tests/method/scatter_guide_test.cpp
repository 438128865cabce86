// lib/scatter_guide.glsl: a photon that scatters by a mixture of BSDF and guide sends the same light
// everywhere.
#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <random>

#include "render/device_scene/albedo_table.h"
#include "shared/render_data.h"
#include "support/gpu_test.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::scatter_guide_test {
namespace {

constexpr double kSignificance = 1e-3;
constexpr std::size_t kSamples = 200'000;
constexpr std::size_t kSectors = 8;  // of directions around the normal

/// As in tests/kernels/scatter_guide.comp.
struct Query {
  float share = 0, uLobe = 0;
  vec2 u{0};
};
struct Answer {
  vec3 wi;
  float weight;
};

class ScatterGuideTest : public test::GpuTest {
 protected:
  /// A guide whose bins weigh from 1 to 9, and the light sent into each sector with a share of samples that
  /// follow it.
  std::array<test::Moments, kSectors> lightBySector(float share, unsigned seed) {
    constexpr uint kBins = kScatterBins * kScatterBins;
    std::vector<float> guide{1};
    for (uint bin = 0; bin < kBins; ++bin) guide.push_back(1 + static_cast<float>(bin * 7 % 9));
    const float sum = std::accumulate(guide.begin() + 1, guide.end(), 0.0f);
    for (uint bin = 1; bin <= kBins; ++bin) guide[bin] = guide[bin] / sum + (bin > 1 ? guide[bin - 1] : 0);
    guide.back() = 1;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 0.99999994f);
    std::vector<Query> queries(kSamples);
    for (Query& q : queries) q = {share, unit(random), {unit(random), unit(random)}};

    const gpu::Kernel kernel(context(), "scatter guide", test_kernels::code("scatter_guide"), {});
    const gpu::Buffer input = gpu::makeBuffer(context(), "queries", std::span<const Query>(queries));
    const gpu::Buffer output(context(), "answers", kSamples * sizeof(Answer));
    const gpu::Buffer albedo = gpu::makeBuffer(context(), "albedo", albedoTable(), gpu::TexelFormat::uint1);
    const gpu::Buffer bins = gpu::makeBuffer(context(), "guide", std::span<const float>(guide));
    const gpu::Buffer* const bindings[] = {&input, &output, &albedo, &bins};
    gpu::Recorder recorder(context());
    recorder.dispatch(kernel, bindings, kSamples, static_cast<std::uint32_t>(kSamples));
    recorder.submitAndWait();
    std::array<test::Moments, kSectors> light;
    for (const Answer& a : output.download<Answer>(kSamples)) {
      const std::size_t sector = (a.wi.x > 0 ? 1u : 0u) + (a.wi.y > 0 ? 2u : 0u) + (a.wi.z > 0.7f ? 4u : 0u);
      for (std::size_t i = 0; i < kSectors; ++i) light[i].add(i == sector ? static_cast<double>(a.weight) : 0);
    }
    return light;
  }
};

// Each sector's mean is known to about half a per cent: a weight that leaves out one of the two densities moves
// it by tens.
TEST_F(ScatterGuideTest, SendsTheSameLightIntoEverySectorWhateverItsShare) {
  const auto plain = lightBySector(0, 1);
  for (const float share : {0.3f, 0.7f}) {
    const auto guided = lightBySector(share, 2);
    for (std::size_t i = 0; i < kSectors; ++i) {
      const test::Moments &a = plain[i], &b = guided[i];
      EXPECT_GT(test::zTest(a.mean(), a.standardError(), b.mean(), b.standardError()).pValue,
                test::sidak(kSignificance, 2 * kSectors))
          << "share " << share << ", sector " << i << ": " << a.mean() << " and " << b.mean();
    }
  }
}

}  // namespace
}  // namespace importon::scatter_guide_test
