// Peter and Pietrek's guides send photons to where they matter: in rooms at least eight times as many lie on what the
// camera sees as by power, of equally many that are traced.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <numeric>

#include "method/render_scene.h"
#include "scene/gltf_loader.h"
#include "support/gpu_test.h"
#include "support/statistics.h"

namespace importon {
namespace {

class GuidedDensity : public test::GpuTest {};

constexpr double kLeastGain = 8, kSignificance = 0.01;

/// Photons per m² where the camera looks: mean over pixels, and so over importance.
double densitySeen(const Scene& scene, const RenderJob& job) {
  const RenderResult result = test::renderScene(scene, job);
  EXPECT_EQ(result.stats.photonsEmitted, static_cast<std::uint64_t>(*job.passes) * *job.photons);
  const std::vector<float>& density = test::channel(result, "density.global.Y");
  return std::accumulate(density.begin(), density.end(), 0.0) / static_cast<double>(density.size());
}

/// The view of the scene's reference.
RenderJob densityJob(std::uint32_t seed) {
  RenderJob job;
  job.width = 64;
  job.height = 64;
  job.passes = 1;
  job.photons = 1u << 16;
  job.gather = 1;
  job.control = DensityControl::off;
  job.aovs = {"density.global"};
  job.guideWeight = GuideWeight::potential;
  job.seed = seed;
  return job;
}

/// Student's test of the mean gain over seeds, on the side that would refute the claim.
void expectLargeGain(const test::Moments& gains, const char* name) {
  std::printf("%s: %.2f times the density by power, standard error %.2f\n", name, gains.mean(), gains.standardError());
  EXPECT_TRUE(gains.mean() >= kLeastGain || test::tTest(gains, kLeastGain).pValue / 2 > kSignificance) << name;
}

TEST_F(GuidedDensity, IsEightTimesThatByPowerWhereRoomsAreSeen) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(std::filesystem::path(IMPORTON_SCENES) / "rooms/rooms.gltf", log);
  test::Moments emission, both;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    RenderJob job = densityJob(seed);
    job.emission = EmissionChoice::power;
    const double byPower = densitySeen(scene, job);
    job.emission = EmissionChoice::guided;
    emission.add(densitySeen(scene, job) / byPower);
    job.scatter = ScatterChoice::guided;
    both.add(densitySeen(scene, job) / byPower);
  }
  expectLargeGain(emission, "guided emission");
  expectLargeGain(both, "guided emission and scattering");
}

}  // namespace
}  // namespace importon
