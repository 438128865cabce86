// Devices that have no more than Vulkan 1.2 promises: the same bits, and no word of the validation layer, which sees
// what the device says of itself. Where kernels need more, an error before anything is built.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;

const std::string kGlassBall = std::string(IMPORTON_SCENES) + "/glass_ball/glass_ball.gltf";

class DeviceLimits : public testing::Test {
 protected:
  /// Renders a small image on a device whose limits are lowered so (lower_limits.h).
  [[nodiscard]] Outcome renderWith(const std::string& limits, const std::string& scene = kCornellBox) const {
    return runImporton(
        {scene, "-o", path(limits), "--width", "24", "--height", "16", "--photons", "4096", "--passes", "2"},
        {.environment = {{"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation:VK_LAYER_IMPORTON_fault"},
                         {"VK_LAYER_PATH", "/usr/share/vulkan/explicit_layer.d:" IMPORTON_FAULT_LAYER},
                         {"IMPORTON_TEST_LIMITS", limits}}});
  }

  [[nodiscard]] std::string path(const std::string& limits) const { return folder_ / ("o-" + limits + ".exr"); }

  void expectSameBits(const std::string& scene, std::initializer_list<const char*> limits) const {
    ASSERT_EQ(renderWith("none", scene).status, 0);
    const std::vector<float> expected = pixelsOf(path("none"));
    for (const char* each : limits) {
      const Outcome outcome = renderWith(each, scene);
      ASSERT_EQ(outcome.status, 0) << each << ": " << outcome.err;
      EXPECT_EQ(outcome.out.find("Validation"), std::string::npos) << each << ": " << outcome.out;
      EXPECT_EQ(outcome.err.find("Validation"), std::string::npos) << each << ": " << outcome.err;
      EXPECT_EQ(pixelsOf(path(each)), expected) << each;
    }
  }

  /// Of all channels, one after the other.
  static std::vector<float> pixelsOf(const std::string& file) {
    std::vector<float> pixels;
    for (const Channel& channel : readExr(file).channels)
      pixels.insert(pixels.end(), channel.values.begin(), channel.values.end());
    return pixels;
  }

  TemporaryFolder folder_;
};

TEST_F(DeviceLimits, SmokeWhatVulkanPromisesIsEnoughForTheSameBits) {
  expectSameBits(kCornellBox, {"texels", "ranges", "workgroups", "shared", "allocations", "timestamps", "all"});
}

TEST_F(DeviceLimits, SlowWhatVulkanPromisesIsEnoughForGlass) {
  expectSameBits(kGlassBall, {"texels", "ranges", "workgroups", "shared", "allocations", "timestamps", "all"});
}

TEST_F(DeviceLimits, SlowADriverThatRoundsDivisionAsItLikesGivesTheSameBits) {
  expectSameBits(kCornellBox, {"driver"});
  expectSameBits(kGlassBall, {"driver"});
}

TEST_F(DeviceLimits, TooFewDescriptorsAreSaidBeforeAnythingIsBuilt) {
  const Outcome outcome = renderWith("descriptors");
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("12 storage buffers in a kernel (it has 4), 18 texel buffers in a kernel (it has 16)"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(folder_.entries(), 0);
}

}  // namespace
}  // namespace importon
