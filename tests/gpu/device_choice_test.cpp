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

using Indices = std::vector<std::size_t>;

std::string refusalOf(const std::string& wanted) {
  try {
    (void)chooseDevices(kDevices, wanted);
  } catch (const DeviceError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error for '" << wanted << "'";
  return "";
}

TEST(DeviceChoice, AllAreTheUsableOnesOfTheBestKind) {
  EXPECT_EQ(chooseDevices(kDevices, "all"), (Indices{3, 4}));
  EXPECT_EQ(chooseDevices(std::vector{device("a", "cpu"), device("b", "cpu")}, "all"), (Indices{0, 1}));
  EXPECT_EQ(chooseDevices(std::vector{device("a", "cpu"), device("b", "integrated")}, "all"), (Indices{1}));
  EXPECT_THROW((void)chooseDevices({}, "all"), DeviceError);
}

TEST(DeviceChoice, AListHasItsOwnOrder) {
  EXPECT_EQ(chooseDevices(kDevices, "4,0"), (Indices{4, 0}));
  EXPECT_EQ(chooseDevices(kDevices, "iris, gtx"), (Indices{2, 4}));
  EXPECT_EQ(chooseDevices(kDevices, "geforce,GEFORCE"), (Indices{3, 4}));
  EXPECT_EQ(chooseDevices(kDevices, "gtx"), (Indices{4}));
  EXPECT_EQ(chooseDevices(kDevices, ""), (Indices{3}));
}

TEST(DeviceChoice, ANameMayHaveACommaInIt) {
  const std::vector devices{device("llvmpipe (LLVM 15, 256 bits)", "cpu"), device("256 bits)", "cpu")};
  EXPECT_EQ(chooseDevices(devices, "llvmpipe (LLVM 15, 256 bits)"), (Indices{0}));
  EXPECT_EQ(chooseDevices(devices, "(LLVM 15,256 bits)"), (Indices{0, 1}));
}

TEST(DeviceChoice, RefusesWhatAListCannotHave) {
  EXPECT_NE(refusalOf("0,voodoo").find("'voodoo'"), std::string::npos);
  EXPECT_NE(refusalOf("0,5").find("'5'"), std::string::npos);
  EXPECT_NE(refusalOf("0,1").find("lacks scalarBlockLayout"), std::string::npos);
  EXPECT_NE(refusalOf("3,3").find("meant twice"), std::string::npos);
  EXPECT_NE(refusalOf("iris,iris").find("meant twice"), std::string::npos);
  EXPECT_NE(refusalOf("0,,2").find("has no name"), std::string::npos);
  EXPECT_NE(refusalOf(",").find("has no name"), std::string::npos);
}

/// A device that two drivers show is used once, by the first of them that has all it takes.
TEST(DeviceChoice, TakesATwinOnlyWhereItIsNamed) {
  std::vector devices{device("A", "discrete", "compute queue"),
                      device("A'", "discrete"),
                      device("B", "discrete"),
                      device("A''", "discrete"),
                      device("?", "discrete"),
                      device("?", "discrete")};
  for (const std::size_t i : {0, 1, 3}) devices[i].identity = "PCI 0 1 0 0";
  devices[2].identity = "PCI 0 2 0 0";
  markTwins(devices);
  EXPECT_EQ(chooseDevices(devices, "all"), (Indices{1, 2, 4, 5}));
  EXPECT_EQ(chooseDevices(devices, "1,3"), (Indices{1, 3}));
}

}  // namespace
}  // namespace importon::gpu
