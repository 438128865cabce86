#include "app/batch/frame_names.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace importon {
namespace {

TEST(FrameNames, HaveTheNumberInItsPlace) {
  const auto name = [](const char* pattern, std::int64_t frame) {
    checkFramePattern("--output", pattern);
    return frameName(pattern, frame).string();
  };
  EXPECT_EQ(name("a.%04d.exr", 7), "a.0007.exr");
  EXPECT_EQ(name("a.%04d.exr", 12345), "a.12345.exr");
  EXPECT_EQ(name("%d", 0), "0");
  EXPECT_EQ(name("x/y/f%03d_1.png", 42), "x/y/f042_1.png");
  EXPECT_EQ(name("100%%_%d.exr", 3), "100%_3.exr");
  EXPECT_EQ(name("a%%d%d", 3), "a%d3");
  EXPECT_EQ(name("50%/%01d.exr", 3), "50%/3.exr") << "a folder's name stays as it is";
}

TEST(FrameNames, NeedExactlyOneNumber) {
  for (const char* pattern : {"a.exr", "",       "a%%d.exr", "a%d_%d.exr",  "a%d%04d",       "a%s.exr", "a%d%s", "a%i",
                              "a%4d",  "a%-4d",  "a%+d",     "a%x",         "a%.3d",         "a%04ld",  "a%04",  "a%",
                              "%0",    "a%123d", "a%0123d",  "out%d/a.exr", "out%d/a%d.exr", "a%n%d",   "%*d"}) {
    EXPECT_THROW(checkFramePattern("--output", pattern), UsageError) << pattern;
  }
}

TEST(FrameNames, AreToldFromPlainOnes) {
  EXPECT_TRUE(hasFrameNumber("s.%d.json"));
  for (const char* plain : {"s.json", "s%%d.json", "%s.json", "d%d/s.json"})
    EXPECT_FALSE(hasFrameNumber(plain)) << plain;
}

}  // namespace
}  // namespace importon
