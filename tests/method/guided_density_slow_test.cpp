// Peter and Pietrek's guides send photons to where they matter: in rooms at least eight times as many lie on what the
// camera sees as by power, of equally many that are traced. Shown by one-sided tests at a significance of 0.01.
#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

#include "method/render_scene.h"
#include "scene/gltf_loader.h"
#include "support/claims.h"
#include "support/gpu_test.h"

namespace importon {
namespace {

class GuidedDensity : public test::GpuTest {};

constexpr double kLeastGain = 8;

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

TEST_F(GuidedDensity, IsEightTimesThatByPowerWhereRoomsAreSeen) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(std::filesystem::path(IMPORTON_SCENES) / "rooms/rooms.gltf", log);
  test::Moments emission, both;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    RenderJob job = densityJob(seed);
    job.emission = EmissionChoice::power;
    const double byPower = densitySeen(scene, job);
    job.emission = EmissionChoice::guided;
    emission.add(densitySeen(scene, job) / byPower);
    job.scatter = ScatterChoice::guided;
    both.add(densitySeen(scene, job) / byPower);
  }
  EXPECT_TRUE(test::isAbove(kLeastGain, emission)) << "guided emission";
  EXPECT_TRUE(test::isAbove(kLeastGain, both)) << "guided emission and scattering";
}

}  // namespace
}  // namespace importon
