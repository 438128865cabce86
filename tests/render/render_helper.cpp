#include "render_helper.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/error.h"
#include "gpu/context.h"
#include "render/device/loaded_device.h"
#include "support/stability.h"

namespace importon::test {
namespace {

bool requiresVulkan() {
  const char* const value = std::getenv("IMPORTON_REQUIRE_VULKAN");
  return value != nullptr && std::string_view(value) == "1";
}

::testing::AssertionResult judge(const TestResult& test, int tests, const std::string& figures) {
  const double least = sidak(kSignificance, tests);
  noteCheck(figures, 1 - std::log(std::max(test.pValue, 1e-300)) / std::log(least));
  if (test.pValue >= least) return ::testing::AssertionSuccess() << figures;
  return ::testing::AssertionFailure() << figures
                                       << fmt::format(": statistic {:.2f}, p = {:.2e} < {:.2e}", test.statistic,
                                                      test.pValue, least);
}

std::string describe(const Moments& m) {
  return fmt::format("{:.6g} +- {:.2g} (n = {})", m.mean(), m.standardError(), m.count());
}

/// Keeps devices for renders that call for the same kernels, one after another. Not for several threads.
class DeviceCache {
 public:
  [[nodiscard]] std::shared_ptr<LoadedDevice> find(const FeatureSet& features, const RenderJob& job) {
    std::string key = fmt::format("{} {} {}", job.validation, features.hasAlpha, job.device);
    for (const auto& [id, value] : constantsOf(features, job, false)) key += fmt::format(" {}={}", id, value);
    if (const auto found = devices_.find(key); found != devices_.end()) return found->second;
    if (devices_.size() >= kMost) devices_.clear();
    return devices_[key] = loadDevice(features, job);
  }
  void clear() { devices_.clear(); }

 private:
  static constexpr std::size_t kMost = 12;  // each holds some tens of MiB of compiled kernels
  std::map<std::string, std::shared_ptr<LoadedDevice>> devices_;
};

/// Renders of a test that call for the same kernels share them.
DeviceCache& devices() {
  static DeviceCache cache;
  return cache;
}

}  // namespace

void RenderTest::TearDownTestSuite() { devices().clear(); }

void RenderTest::SetUp() {
  try {
    (void)gpu::listDevices();
  } catch (const DeviceError& error) {
    if (requiresVulkan()) FAIL() << error.what();
    GTEST_SKIP() << error.what();
  }
}

RenderJob makeJob(Integrator integrator, int passes, std::uint32_t seed) {
  RenderJob job;
  job.integrator = integrator;
  job.passes = passes;
  job.seed = seed;
  job.sharesLight = false;
  if (integrator == Integrator::photon) {
    job.photons = 1u << 13;
    job.importons = 1u << 11;
  }
  return job;
}

Rendered renderScene(const RenderJob& job, const Scene& scene) {
  Log log(Log::Verbosity::quiet);
  const std::atomic<bool> isInterrupted = false;
  RenderResult result = render(
      job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now(),
      {.device = [](const FeatureSet& features, const RenderJob& theJob) { return devices().find(features, theJob); }});
  return {std::move(result.image), std::move(result.stats), log.warnings()};
}

Region wholeOf(const Image& image) { return {0, 0, image.width, image.height}; }

std::vector<float> valuesOf(const Image& image, const Region& region, const std::string& channel) {
  const Channel* const plane = image.find(channel);
  if (plane == nullptr) throw std::invalid_argument("the image has no channel " + channel);
  std::vector<float> values;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x)
      values.push_back(plane->values.at(static_cast<std::size_t>(y * image.width + x)));
  return values;
}

std::vector<float> valuesOf(const Image& image, const std::string& channel) {
  return valuesOf(image, wholeOf(image), channel);
}

double meanOf(const Image& image, const Region& region, const std::string& channel) {
  const std::vector<float> values = valuesOf(image, region, channel);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double meanOf(const Image& image, const std::string& channel) { return meanOf(image, wholeOf(image), channel); }

std::vector<Moments> overSeeds(RenderJob job, const Scene& scene, int seeds,
                               const std::function<std::vector<double>(const Rendered&)>& figures) {
  std::vector<Moments> moments;
  for (int seed = 1; seed <= seeds; ++seed) {
    job.seed = static_cast<std::uint32_t>(seed);
    const std::vector<double> values = figures(renderScene(job, scene));
    moments.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) moments[i].add(values[i]);
  }
  return moments;
}

Moments meanOverSeeds(const RenderJob& job, const Scene& scene, int seeds) {
  return overSeeds(job, scene, seeds, [](const Rendered& r) { return std::vector{meanOf(r.image)}; }).front();
}

::testing::AssertionResult haveSameBits(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size())
    return ::testing::AssertionFailure() << "the images have different sizes or channels";
  noteCheck("the same bits", 1);
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    const std::vector<float>&va = a.channels[c].values, &vb = b.channels[c].values;
    if (va.size() != vb.size()) return ::testing::AssertionFailure() << "channels of different sizes";
    std::size_t differing = 0, first = 0;
    for (std::size_t i = va.size(); i-- > 0;) {
      if (std::bit_cast<std::uint32_t>(va[i]) == std::bit_cast<std::uint32_t>(vb[i])) continue;
      ++differing;
      first = i;
    }
    if (differing > 0)
      return ::testing::AssertionFailure()
             << fmt::format("{} of {} values of channel {} differ, the first at {}: {:.9g} and {:.9g}", differing,
                            va.size(), a.channels[c].name, first, va[first], vb[first]);
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult hasMean(const Moments& values, double expected, int tests) {
  return judge(tTest(values, expected), tests, fmt::format("{}, expected {:.6g}", describe(values), expected));
}

::testing::AssertionResult haveSameMean(const Moments& a, const Moments& b, int tests) {
  return judge(welchTest(a, b), tests, fmt::format("{} and {}", describe(a), describe(b)));
}

std::vector<double> planeImage(const Scene& scene, const glm::dvec3& point, const glm::dvec3& normal,
                               const std::function<double(const glm::dvec3&)>& radiance) {
  constexpr int kPoints = 16;
  const Camera& camera = scene.cameras.front();
  const glm::dvec3 origin(camera.worldFromCamera[3]);
  const double halfHeight = std::tan(camera.yfov / 2), halfWidth = halfHeight * camera.aspectRatio;
  const auto radianceAlong = [&](double x, double y) {
    const glm::dvec3 local((2 * x / camera.width - 1) * halfWidth, (1 - 2 * y / camera.height) * halfHeight, -1);
    const glm::dvec3 direction = glm::dmat3(camera.worldFromCamera) * local;
    return radiance(origin + direction * (glm::dot(point - origin, normal) / glm::dot(direction, normal)));
  };
  std::vector<double> pixels;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double sum = 0;
      for (int row = 0; row < kPoints; ++row)
        for (int column = 0; column < kPoints; ++column)
          sum += radianceAlong(x + (column + 0.5) / kPoints, y + (row + 0.5) / kPoints);
      pixels.push_back(sum / (kPoints * kPoints));
    }
  }
  return pixels;
}

::testing::AssertionResult isImageOf(const Image& image, const std::vector<double>& expected, int blocks,
                                     const std::string& channel) {
  const std::vector<float> values = valuesOf(image, channel);
  if (values.size() != expected.size()) return ::testing::AssertionFailure() << "another number of pixels";
  std::vector<Moments> ratios(static_cast<std::size_t>(blocks * blocks));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int x = static_cast<int>(i) % image.width, y = static_cast<int>(i) / image.width;
    const int block = y * blocks / image.height * blocks + x * blocks / image.width;
    ratios[static_cast<std::size_t>(block)].add(static_cast<double>(values[i]) / expected[i]);
  }
  for (std::size_t b = 0; b < ratios.size(); ++b) {
    const ::testing::AssertionResult result = hasMean(ratios[b], 1, blocks * blocks);
    if (!result) return ::testing::AssertionFailure() << "block " << b << ": " << result.message();
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult isConstant(const Image& image, double expected, double tolerance) {
  double most = 0;
  for (const Channel& channel : image.channels)
    for (const float value : channel.values) most = std::max(most, std::abs(static_cast<double>(value) / expected - 1));
  noteCheck(fmt::format("off by {:.1e} of it", most), 1 - most / tolerance);
  for (const Channel& channel : image.channels)
    for (const float value : channel.values)
      if (!(std::abs(static_cast<double>(value) - expected) <= tolerance * expected))
        return ::testing::AssertionFailure()
               << fmt::format("channel {} holds {:.8g}, expected {:.8g}", channel.name, value, expected);
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult isSane(const Image& image) {
  noteCheck("finite, not negative", 1);
  for (const Channel& channel : image.channels)
    for (const float value : channel.values)
      if (!std::isfinite(value) || value < 0)
        return ::testing::AssertionFailure() << "channel " << channel.name << " holds " << value;
  return ::testing::AssertionSuccess();
}

}  // namespace importon::test
