// Devices that are lost or have no memory left: an error that says so, exit status 3, and no file.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;

class DeviceFaults : public testing::Test {
 protected:
  /// Renders a small image of two passes on a device with this fault: see fault_layer.cpp.
  [[nodiscard]] Outcome renderWith(const std::string& fault) const {
    return runImporton({kCornellBox, "-o", folder_ / "o.exr", "--stats", folder_ / "o.json", "--width", "32",
                        "--height", "24", "--photons", "4096", "--importons", "2048", "--passes", "2"},
                       {.environment = {{"VK_INSTANCE_LAYERS", "VK_LAYER_IMPORTON_fault"},
                                        {"VK_LAYER_PATH", IMPORTON_FAULT_LAYER},
                                        {"IMPORTON_TEST_FAULT", fault}}});
  }

  /// One line `importon: error: WHAT (WHERE): WHAT TO DO`, exit status 3, no file.
  void expectDeviceError(const Outcome& outcome, const std::vector<std::string>& parts) const {
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_EQ(outcome.err.find("importon: error: "), 0u) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& part : parts) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.entries(), 0);
  }

  TemporaryFolder folder_;
};

TEST_F(DeviceFaults, SmokeWithoutOneTheImageIsWritten) {
  const Outcome outcome = renderWith("none 0");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(readExr(folder_ / "o.exr").width, 32);
}

TEST_F(DeviceFaults, ALostDeviceIsADeviceErrorWheneverItComes) {
  for (const char* fault : {"lost 1", "lost 4"})
    expectDeviceError(renderWith(fault), {"the device was lost", "try again"});
}

TEST_F(DeviceFaults, NoMemoryLeftSaysWhatIsNeededAndWhatThereIs) {
  for (const char* fault : {"memory 0", "memory 8"})
    expectDeviceError(renderWith(fault),
                      {"out of device memory: cannot allocate ", " MiB for buffer '", " MiB in use, of ", "--memory"});
}

TEST_F(DeviceFaults, ADeviceThatIsTooSmallSaysWhatIsNeededAndWhatThereIs) {
  expectDeviceError(renderWith("heap 1"), {"needs ", " MiB, but the device's memory is 1 MiB"});
}

}  // namespace
}  // namespace importon
