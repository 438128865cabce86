// Radiance pictures: both kinds of run lengths, orientations, and files that are damaged or made to hurt.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/image.h"

namespace importon::hdr_test {
namespace {

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

Image decode(const std::string& bytes) {
  return decodeHdr({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, "sky.hdr");
}

std::string errorOf(const std::string& bytes) {
  try {
    (void)decode(bytes);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

std::string bytes(const std::vector<int>& values) { return {values.begin(), values.end()}; }

/// Red 1 2 3 ..., green 0, blue 1/2: exponent 136 is 2^0 for whole numbers up to 255.
std::string flatPixels(int count) {
  std::string pixels;
  for (int i = 0; i < count; ++i) pixels += bytes({i + 2, 0, 1, 136});
  return pixels;
}

TEST(Hdr, ReadsFlatPixels) {
  const Image image = decode(kHeader + "-Y 2 +X 3\n" + flatPixels(6));
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.find("R")->values, (std::vector<float>{2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(image.find("G")->values, std::vector<float>(6, 0));
  EXPECT_EQ(image.find("B")->values, std::vector<float>(6, 1));
}

TEST(Hdr, ScalesByItsExponentAndUndoesExposures) {
  const Image image = decode("#?RGBE\nEXPOSURE=4\nVIEW= -vtv\nEXPOSURE= 0.5\n\n-Y 1 +X 3\n" +
                             bytes({128, 64, 0, 129, 255, 255, 255, 0, 1, 2, 4, 138}));
  EXPECT_EQ(image.find("R")->values, (std::vector<float>{0.5f, 0, 2})) << "128/256 · 2, black, 4; over 2";
  EXPECT_EQ(image.find("G")->values, (std::vector<float>{0.25f, 0, 4}));
}

TEST(Hdr, ReadsOldRuns) {
  const std::string run = bytes({9, 8, 7, 136, 1, 1, 1, 4, 1, 1, 1, 1, 3, 3, 3, 136});
  const Image image = decode(kHeader + "-Y 1 +X 262\n" + run);  // 1 + 4 + 256 pixels, and another
  EXPECT_EQ(image.find("R")->values[0], 9);
  EXPECT_EQ(image.find("R")->values[260], 9);
  EXPECT_EQ(image.find("R")->values[261], 3);
}

TEST(Hdr, ReadsNewRuns) {
  const std::string line = bytes({2, 2, 0, 10, 138, 5, 3, 1, 2, 3, 135, 9, 138, 0, 138, 136});
  const Image image = decode(kHeader + "-Y 2 +X 10\n" + line + line);
  EXPECT_EQ(image.find("R")->values, std::vector<float>(20, 5));
  const std::vector<float>& green = image.find("G")->values;
  EXPECT_EQ(std::vector<float>(green.begin() + 10, green.end()), (std::vector<float>{1, 2, 3, 9, 9, 9, 9, 9, 9, 9}));
}

/// The same three by two pixels, as lines and columns go in each of the eight ways.
TEST(Hdr, TurnsEveryOrientationUpright) {
  const auto redOf = [](const std::string& size) {
    return decode(kHeader + size + "\n" + flatPixels(6)).find("R")->values;
  };
  EXPECT_EQ(redOf("-Y 2 -X 3"), (std::vector<float>{4, 3, 2, 7, 6, 5}));
  EXPECT_EQ(redOf("+Y 2 +X 3"), (std::vector<float>{5, 6, 7, 2, 3, 4}));
  EXPECT_EQ(redOf("+Y 2 -X 3"), (std::vector<float>{7, 6, 5, 4, 3, 2}));
  EXPECT_EQ(redOf("+X 3 -Y 2"), (std::vector<float>{2, 4, 6, 3, 5, 7}));
  EXPECT_EQ(redOf("-X 3 -Y 2"), (std::vector<float>{6, 4, 2, 7, 5, 3}));
  EXPECT_EQ(redOf("+X 3 +Y 2"), (std::vector<float>{3, 5, 7, 2, 4, 6}));
  EXPECT_EQ(redOf("-X 3 +Y 2"), (std::vector<float>{7, 5, 3, 6, 4, 2}));
}

TEST(Hdr, RefusesWhatItCannotHold) {
  const std::string size = "-Y 1 +X 10\n";
  for (const auto& [file, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "ends too early"},
           {"#?RADIANCE", "ends too early"},
           {"BM\n\n" + size, "no Radiance picture"},
           {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n" + size, "not in RGBE"},
           {"#?RADIANCE\nEXPOSURE=0\n\n" + size, "exposure"},
           {"#?RADIANCE\nEXPOSURE=1e300\nEXPOSURE=1e300\n\n" + size, "exposures"},
           {kHeader + "-Y 10\n", "size"},
           {kHeader + "-Y 10 +Y 10\n" + flatPixels(100), "twice"},
           {kHeader + "-Y 0 +X 10\n", "size"},
           {kHeader + "-Y 65537 +X 10\n", "size"},
           {kHeader + "-Y 99999999999999999999 +X 10\n", "size"},
           {kHeader + "-Y 60000 +X 60000\n" + flatPixels(6), "too short to hold 60000 x 60000"},
           {kHeader + size + flatPixels(9), "end too early"},
           {kHeader + size + bytes({2, 2, 0, 11, 138, 5}), "another length"},
           {kHeader + size + bytes({2, 2, 0, 10, 139, 5}), "does not fit"},
           {kHeader + size + bytes({2, 2, 0, 10, 0, 5}), "does not fit"},
           {kHeader + size + bytes({2, 2, 0, 10, 138}), "end too early"},
           {kHeader + size + bytes({1, 1, 1, 5}), "does not fit"},
           {kHeader + size + bytes({9, 9, 9, 9, 1, 1, 1, 10}), "does not fit"},
           {kHeader + size + bytes({9, 9, 9, 9, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0}),
            "does not fit"}})
    EXPECT_NE(errorOf(file).find(what), std::string::npos) << what << ": " << errorOf(file);
}

TEST(Hdr, AnyCutOfAFileIsRefused) {
  const std::string line = bytes({2, 2, 0, 10, 138, 5, 3, 1, 2, 3, 135, 9, 138, 0, 138, 136});
  const std::string whole = kHeader + "-Y 2 +X 10\n" + line + line;
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(errorOf(whole.substr(0, length)), "") << length;
  EXPECT_EQ(errorOf(whole), "");
}

}  // namespace
}  // namespace importon::hdr_test
