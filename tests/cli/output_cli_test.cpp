// Pictures by the names of their files, and what OpenEXR's header tells.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon::output_cli_test {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::readFile;
using test::runImporton;
using test::TemporaryFolder;
using test::writeFile;

class OutputTest : public testing::Test {
 protected:
  /// A small render of the box of few photons.
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), kCornellBox);
    arguments.insert(arguments.end(), {"--width", "40", "--height", "24", "--photons", "4096", "--importons", "2048",
                                       "--passes", "1", "-q"});
    return runImporton(arguments);
  }
  void expectRefusal(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    for (const std::string& part : parts) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
  TemporaryFolder folder_;
};

using CliOutput = OutputTest;
using CliOutputRender = OutputTest;

TEST_F(CliOutput, RefusesNamesOfOtherKinds) {
  for (const char* name : {"a.tif", "a.exr.bak", "a.json", "a."})
    expectRefusal({"-o", folder_ / name}, {"--output names no kind", name, ".exr"});
  for (const char* name : {"a.exr", "a.hdr", "a.bmp"})
    expectRefusal({"-o", folder_ / "o.exr", "--png", folder_ / name}, {"--png names no kind", ".jpg"});
  expectRefusal({"-o", folder_ / "a.png", "--aov", "depth"}, {"--aov needs an OpenEXR file"});
  expectRefusal({"-o", folder_ / "a.hdr", "--half"}, {"--half needs an OpenEXR file"});
  expectRefusal({"-o", folder_ / "a.exr", "--png-depth", "12"}, {"--png-depth"});
  writeFile(folder_ / "jobs", "a.glb -o a.tif\n");
  const Outcome list = runImporton({"--list", folder_ / "jobs", "-o", folder_ / "out"});
  EXPECT_EQ(list.status, 1);
  EXPECT_NE(list.err.find("a.tif"), std::string::npos) << list.err;
  EXPECT_EQ(folder_.entries(), 1);
}

TEST_F(CliOutputRender, ShowsTheSamePictureInEachKind) {
  ASSERT_EQ(run({"-o", folder_ / "a.exr", "--png", folder_ / "a.png"}).status, 0);
  for (const char* name : {"o.hdr", "o.png", "o.jpg", "deep.png"}) {
    std::vector<std::string> arguments{"-o", folder_ / name};
    if (name == std::string("deep.png")) arguments.insert(arguments.end(), {"--png-depth", "16"});
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
  EXPECT_EQ(readFile(folder_ / "o.png"), readFile(folder_ / "a.png"));
  EXPECT_EQ(readFile(folder_ / "deep.png")[24], 16) << "bits of a channel, in the header";
  EXPECT_EQ(readFile(folder_ / "o.jpg").substr(0, 3), "\xFF\xD8\xFF");
  const Image exr = readExr(folder_ / "a.exr"), hdr = readHdr(folder_ / "o.hdr");
  ASSERT_EQ(hdr.width, 40);
  for (std::size_t i = 0; i < 40 * 24; ++i) {
    float most = 0;
    for (const char* name : {"R", "G", "B"}) most = std::max(most, exr.find(name)->values[i]);
    for (const char* name : {"R", "G", "B"})
      EXPECT_NEAR(hdr.find(name)->values[i], std::max(0.0F, exr.find(name)->values[i]), most / 256) << name << i;
  }
  ASSERT_EQ(run({"-o", folder_ / "plain", "--png", folder_ / "p.jpeg"}).status, 0);
  EXPECT_EQ(readFile(folder_ / "plain"), readFile(folder_ / "a.exr")) << "a name without an extension is OpenEXR's";
  EXPECT_EQ(readFile(folder_ / "p.jpeg"), readFile(folder_ / "o.jpg"));
}

TEST_F(CliOutputRender, TellsWhatAKindCannotHold) {
  const Outcome outcome = run({"-o", folder_ / "o.jpg", "--transparent", "--png-depth", "16"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("no opacity"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--png-depth is of the PNG"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"-o", folder_ / "o.jpg", "--exposure", "1"}).err, "") << "an exposure is of use to a JPEG";
}

/// A float with no more digits than half floats have.
bool isHalf(float value) { return (std::bit_cast<std::uint32_t>(value) & 0x1FFFu) == 0; }

TEST_F(CliOutputRender, HasHalfFloatsForColoursAlone) {
  const std::vector<std::string> layers{"--aov", "P,depth,direct,variance"};
  const auto render = [&](const char* name, std::vector<std::string> more) {
    more.insert(more.begin(), {"-o", folder_ / name});
    more.insert(more.end(), layers.begin(), layers.end());
    EXPECT_EQ(run(more).status, 0);
    return readExr(folder_ / name);
  };
  const Image full = render("full.exr", {}), half = render("half.exr", {"--half"});
  for (const char* name : {"R", "G", "B", "direct.R", "direct.B"}) {
    EXPECT_TRUE(std::ranges::all_of(half.find(name)->values, isHalf)) << name;
    EXPECT_FALSE(std::ranges::all_of(full.find(name)->values, isHalf)) << name;
    for (std::size_t i = 0; i < 40 * 24; ++i) {
      const float value = full.find(name)->values[i];
      EXPECT_NEAR(half.find(name)->values[i], value, std::abs(value) * 0x1p-11 + 0x1p-24) << name;
    }
  }
  for (const char* name : {"P.X", "P.Y", "P.Z", "depth.Z", "variance.R"})
    EXPECT_EQ(half.find(name)->values, full.find(name)->values) << name;
}

/// Row vectors from the left, as OpenEXR has them.
std::array<double, 4> times(const std::array<double, 3>& point, const ImageMatrix& matrix) {
  std::array<double, 4> result{};
  for (std::size_t k = 0; k < 4; ++k) {
    result[k] = matrix[12 + k];
    for (std::size_t i = 0; i < 3; ++i) result[k] += point[i] * static_cast<double>(matrix[4 * i + k]);
  }
  return result;
}

/// What the matrices make of the points that the pixels see.
TEST_F(CliOutputRender, HeaderTellsWhereTheCameraStood) {
  ASSERT_EQ(run({"-o", folder_ / "a.exr", "--aov", "P,depth"}).status, 0);
  const Image image = readExr(folder_ / "a.exr");
  EXPECT_EQ(image.attributes.at("software").find("importon "), 0u);
  const ImageMatrix toCamera = image.matrices.at("worldToCamera"), toImage = image.matrices.at("worldToNDC");
  int seen = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 40; ++x) {
      const auto i = static_cast<std::size_t>(40 * y + x);
      if (!(image.find("depth.Z")->values[i] < 100)) continue;
      const std::array<double, 3> p{image.find("P.X")->values[i], image.find("P.Y")->values[i],
                                    image.find("P.Z")->values[i]};
      const std::array<double, 4> ndc = times(p, toImage), camera = times(p, toCamera);
      EXPECT_NEAR(ndc[0] / ndc[3], (x + 0.5) / 40, 1e-4);
      EXPECT_NEAR(ndc[1] / ndc[3], (y + 0.5) / 24, 1e-4);
      EXPECT_GT(camera[2], 0) << "the camera looks along +z of its own space";
      EXPECT_EQ(camera[0] > 0, x >= 20);
      EXPECT_EQ(camera[1] > 0, y < 12);
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

TEST_F(CliOutputRender, MergeKeepsTheHeader) {
  for (const char* seed : {"1", "2"})
    ASSERT_EQ(run({"-o", folder_ / (std::string(seed) + ".exr"), "--seed", seed}).status, 0);
  ASSERT_EQ(
      runImporton({"merge", folder_ / "1.exr", folder_ / "2.exr", "-o", folder_ / "m.exr", "--png", folder_ / "m.jpg"})
          .status,
      0);
  EXPECT_EQ(readExr(folder_ / "m.exr").matrices, readExr(folder_ / "1.exr").matrices);
  EXPECT_EQ(readFile(folder_ / "m.jpg").substr(0, 3), "\xFF\xD8\xFF");
  EXPECT_EQ(
      runImporton({"merge", folder_ / "1.exr", folder_ / "2.exr", "-o", folder_ / "m.exr", "--png", folder_ / "m.hdr"})
          .status,
      1);
}

}  // namespace
}  // namespace importon::output_cli_test
