// Images with the same bits on another driver, which scripts/test names by IMPORTON_TEST_OTHER_DRIVER (a file of the
// Vulkan loader); without one the tests are skipped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::Outcome;
using test::runImporton;

class CliRenderSameBits : public testing::TestWithParam<const char*> {
 protected:
  /// All channels, one after the other; empty if the render failed.
  [[nodiscard]] std::vector<float> render(const std::string& scene,
                                          const std::map<std::string, std::string>& environment) {
    const std::string file = std::string(IMPORTON_SCENES) + "/" + scene + "/" + scene + ".gltf";
    const std::string output = folder_ / "o.exr";
    const Outcome outcome = runImporton(
        {file, "-o", output, "--width", "48", "--height", "48", "--passes", "1", "--aov", "caustic,importance.caustic"},
        {.environment = environment});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::vector<float> values;
    if (outcome.status == 0)
      for (const Channel& channel : readExr(output).channels)
        values.insert(values.end(), channel.values.begin(), channel.values.end());
    return values;
  }

  test::TemporaryFolder folder_;
};

// With panes, and a sky whose photons are aimed; and, slow, with caustic maps and lone sites in the importance map.
TEST_P(CliRenderSameBits, OnAnotherDriver) {
  const char* const other = std::getenv("IMPORTON_TEST_OTHER_DRIVER");
  if (other == nullptr || *other == '\0') GTEST_SKIP() << "IMPORTON_TEST_OTHER_DRIVER names no driver";
  const std::vector<float> own = render(GetParam(), {});
  ASSERT_FALSE(own.empty());
  EXPECT_EQ(own, render(GetParam(), {{"VK_DRIVER_FILES", other}}));
}

INSTANTIATE_TEST_SUITE_P(Of, CliRenderSameBits, ::testing::Values("window", "pool"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace importon
