/// Renders scenes made in memory and takes figures from the images.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "base/log.h"
#include "render/render.h"
#include "support/claims.h"
#include "support/scene_builder.h"
#include "support/stability.h"
#include "support/statistics.h"

namespace importon::test {

/// The probability with which a test that samples fails although the renderer is right, over all that the test
/// compares; see sidak.
inline constexpr double kSignificance = 1e-3;

/// Base class of tests that render. Without a Vulkan device they are skipped, saying so; with
/// IMPORTON_REQUIRE_VULKAN=1 in the environment, as in CI, they fail.
class RenderTest : public ::testing::Test {
 protected:
  void SetUp() override;
  static void TearDownTestSuite();
};

struct Rendered {
  Image image;
  RenderStats stats;
  std::vector<Warning> warnings;
};

/// A job of exactly `passes` passes that shares no indirect light among pixels, with few importons and photons.
[[nodiscard]] RenderJob makeJob(Integrator integrator, int passes, std::uint32_t seed = 0);

/// Renders in silence.
[[nodiscard]] Rendered renderScene(const RenderJob& job, const Scene& scene);

/// Pixels x0 <= x < x1, y0 <= y < y1, from the top left.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
[[nodiscard]] Region wholeOf(const Image& image);

/// Values of a channel ("R", "G", "B", or an AOV's) in a region, or in all of the image.
[[nodiscard]] std::vector<float> valuesOf(const Image& image, const Region& region, const std::string& channel = "R");
[[nodiscard]] std::vector<float> valuesOf(const Image& image, const std::string& channel = "R");

/// Mean over a region.
[[nodiscard]] double meanOf(const Image& image, const Region& region, const std::string& channel = "R");
[[nodiscard]] double meanOf(const Image& image, const std::string& channel = "R");

/// What `figures` takes from renders with the seeds 1 .. `seeds`: moments of each figure over the seeds, which
/// are independent, whereas passes are not.
[[nodiscard]] std::vector<Moments> overSeeds(RenderJob job, const Scene& scene, int seeds,
                                             const std::function<std::vector<double>(const Rendered&)>& figures);

/// Mean of the red channel over the image, over seeds.
[[nodiscard]] Moments meanOverSeeds(const RenderJob& job, const Scene& scene, int seeds);

/// The same size, channels and bits.
[[nodiscard]] ::testing::AssertionResult haveSameBits(const Image& a, const Image& b);

/// Student's test of the mean, as a message that says the figures. `tests`: how many the test makes in all.
[[nodiscard]] ::testing::AssertionResult hasMean(const Moments& values, double expected, int tests = 1);

/// Welch's test that two samples have one mean.
[[nodiscard]] ::testing::AssertionResult haveSameMean(const Moments& a, const Moments& b, int tests = 1);

/// What the image's pixels are in the mean if `radiance` holds where the scene's first camera looks: on the
/// plane through `point` with `normal` (world), 16 x 16 points a pixel.
[[nodiscard]] std::vector<double> planeImage(const Scene& scene, const glm::dvec3& point, const glm::dvec3& normal,
                                             const std::function<double(const glm::dvec3&)>& radiance);

/// Student's test that values / expected has the mean 1, in each of blocks x blocks parts of an image.
[[nodiscard]] ::testing::AssertionResult isImageOf(const Image& image, const std::vector<double>& expected,
                                                   int blocks = 3, const std::string& channel = "R");

/// True if all values of the three channels are within relative `tolerance` of `expected`: for images without
/// noise.
[[nodiscard]] ::testing::AssertionResult isConstant(const Image& image, double expected, double tolerance);

/// True where all values are finite and none is negative.
[[nodiscard]] ::testing::AssertionResult isSane(const Image& image);

}  // namespace importon::test
