#include "base/error.h"

#include <gtest/gtest.h>

namespace importon {
namespace {

TEST(Error, JoinsWhatWhereAndRemedy) {
  const SceneError error("index 7 is out of range", "a.gltf#/accessors/3", "export the file anew");
  EXPECT_STREQ(error.what(), "index 7 is out of range (a.gltf#/accessors/3): export the file anew");
}

TEST(Error, LeavesOutAnEmptyPlace) {
  EXPECT_STREQ(DeviceError("no device", "", "install a driver").what(), "no device: install a driver");
}

TEST(Error, StaysOnOneLineWhateverTheFileName) {
  EXPECT_STREQ(OutputError("cannot write", "a\nb\tc.exr", "choose\r\nanother").what(),
               "cannot write (a b c.exr): choose  another");
}

TEST(Error, KeepsBytesOfUtf8) {
  EXPECT_STREQ(OutputError("cannot write", "übung.exr", "x").what(), "cannot write (übung.exr): x");
}

TEST(Error, CarriesTheExitStatusOfItsKind) {
  EXPECT_EQ(static_cast<int>(UsageError("", "", "").status()), 1);
  EXPECT_EQ(static_cast<int>(SceneError("", "", "").status()), 2);
  EXPECT_EQ(static_cast<int>(DeviceError("", "", "").status()), 3);
  EXPECT_EQ(static_cast<int>(OutputError("", "", "").status()), 4);
}

}  // namespace
}  // namespace importon
