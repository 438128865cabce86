#include "gpu/device_choice.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/error.h"

namespace importon::gpu {
namespace {

DeviceInfo device(const char* name, const char* type, const char* missing = "") {
  DeviceInfo info;
  info.name = name;
  info.type = type;
  info.missing = missing;
  return info;
}

const std::vector<DeviceInfo> kDevices = {
    device("llvmpipe", "cpu"),
    device("Radeon RX 480", "discrete", "scalarBlockLayout"),
    device("Intel Iris", "integrated"),
    device("GeForce RTX 4090", "discrete"),
    device("GeForce GTX 1080", "discrete"),
};

std::string messageFor(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
  try {
    (void)chooseDevice(devices, wanted);
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.status(), ExitStatus::device);
    return error.what();
  }
  ADD_FAILURE() << "no error for '" << wanted << "'";
  return "";
}

TEST(DeviceChoice, DefaultIsTheFirstUsableDiscreteDevice) {
  EXPECT_EQ(defaultDevice(kDevices), 3u);
  EXPECT_EQ(chooseDevice(kDevices, ""), 3u);
}

TEST(DeviceChoice, DefaultFallsBackByType) {
  EXPECT_EQ(defaultDevice(std::vector{device("a", "cpu"), device("b", "virtual")}), 1u);
  EXPECT_EQ(defaultDevice(std::vector{device("a", "virtual"), device("b", "integrated")}), 1u);
  EXPECT_EQ(defaultDevice(std::vector{device("a", "other"), device("b", "cpu")}), 1u);
  EXPECT_EQ(defaultDevice(std::vector{device("a", "cpu", "Vulkan 1.2")}), 1u);
}

TEST(DeviceChoice, TakesAnIndex) {
  EXPECT_EQ(chooseDevice(kDevices, "0"), 0u);
  EXPECT_EQ(chooseDevice(kDevices, "4"), 4u);
}

TEST(DeviceChoice, TakesAPartOfTheNameInAnyCase) {
  EXPECT_EQ(chooseDevice(kDevices, "gtx 10"), 4u);
  EXPECT_EQ(chooseDevice(kDevices, "LLVM"), 0u);
  EXPECT_EQ(chooseDevice(kDevices, "geforce"), 3u);
}

TEST(DeviceChoice, PrefersAUsableDeviceOfThatName) {
  EXPECT_EQ(chooseDevice(std::vector{device("GPU A", "discrete", "x"), device("GPU B", "discrete")}, "gpu"), 1u);
}

TEST(DeviceChoice, RefusesAnUnknownName) {
  const std::string message = messageFor(kDevices, "voodoo");
  EXPECT_NE(message.find("no Vulkan device is named 'voodoo'"), std::string::npos) << message;
  EXPECT_NE(message.find("importon devices"), std::string::npos) << message;
}

TEST(DeviceChoice, RefusesAnIndexPastTheLast) {
  EXPECT_NE(messageFor(kDevices, "5").find("'5'"), std::string::npos);
  EXPECT_NE(messageFor(kDevices, "18446744073709551616").find("no Vulkan device"), std::string::npos);
}

TEST(DeviceChoice, NamesWhatARefusedDeviceLacks) {
  const std::string message = messageFor(kDevices, "radeon");
  EXPECT_NE(message.find("lacks scalarBlockLayout"), std::string::npos) << message;
  EXPECT_NE(message.find("Radeon RX 480"), std::string::npos) << message;
}

TEST(DeviceChoice, NamesWhatIsMissingWhenNoDeviceIsUsable) {
  const std::string message = messageFor({device("Old GPU", "discrete", "Vulkan 1.2")}, "");
  EXPECT_NE(message.find("Vulkan 1.2 is missing (Old GPU)"), std::string::npos) << message;
}

}  // namespace
}  // namespace importon::gpu
