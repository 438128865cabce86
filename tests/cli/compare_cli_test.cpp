#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;

/// Writes 4 x 2 grey pixels.
std::string writeGrey(const TemporaryFolder& folder, const std::string& name, float value, int width = 4) {
  Image image{width, 2, {}, {}};
  for (const char* channel : {"R", "G", "B"}) {
    image.channels.push_back({channel, std::vector<float>(static_cast<std::size_t>(2 * width), value)});
  }
  writeExr(folder / name, image);
  return folder / name;
}

TEST(Cli, ComparePrintsEveryMetric) {
  const TemporaryFolder folder;
  const Outcome outcome = runImporton({"compare", writeGrey(folder, "a.exr", 2), writeGrey(folder, "r.exr", 1)});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* line : {"relmse          0.990099", "relmse_trimmed  0.990099", "smape           0.333333",
                           "rmse            1\n", "mean_ratio      2\n", "flip            0.", "flip_hdr        0."}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << " in\n" << outcome.out;
  }
}

TEST(Cli, CompareWritesJson) {
  const TemporaryFolder folder;
  const Outcome outcome =
      runImporton({"compare", writeGrey(folder, "a.exr", 2), writeGrey(folder, "r.exr", 1), "--json", "--floor", "0"});
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_NEAR(json["relmse"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(json["relmse_trimmed"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(json["smape"].get<double>(), 1.0 / 3, 1e-9);
  EXPECT_NEAR(json["rmse"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(json["mean_ratio"].get<double>(), 2, 1e-9);
  EXPECT_GT(json["flip"].get<double>(), 0);
  EXPECT_EQ(json["non_finite_pixels"], 0);
}

TEST(Cli, CompareExitsWithFiveAboveALimit) {
  const TemporaryFolder folder;
  const std::string a = writeGrey(folder, "a.exr", 2), r = writeGrey(folder, "r.exr", 1);
  EXPECT_EQ(runImporton({"compare", a, r, "--max-relmse", "1"}).status, 0);
  EXPECT_EQ(runImporton({"compare", a, r, "--max-relmse", "0.9"}).status, 5);
  EXPECT_EQ(runImporton({"compare", a, r, "--max-flip", "1"}).status, 0);
  EXPECT_EQ(runImporton({"compare", a, r, "--max-flip", "0.001"}).status, 5);
  EXPECT_EQ(runImporton({"compare", a, a, "--max-flip", "0", "--max-relmse", "0"}).status, 0);
}

TEST(Cli, CompareGivesBlotchesInPercentAndLimitsThem) {
  constexpr int kSide = 64;
  const TemporaryFolder folder;
  std::vector<float> wavy;  // 20 pixels long, ±5 %: of that 78 % are in the band
  for (int i = 0; i < kSide * kSide; ++i)
    wavy.push_back(1 + 0.05F * std::sin(static_cast<float>(i % kSide) * 2 * std::numbers::pi_v<float> / 20));
  writeExr(folder / "a.exr", {kSide, kSide, {{"R", wavy}, {"G", wavy}, {"B", wavy}}, {}});
  const std::vector<float> flat(wavy.size(), 1.0F);
  writeExr(folder / "r.exr", {kSide, kSide, {{"R", flat}, {"G", flat}, {"B", flat}}, {}});
  const std::string a = folder / "a.exr", r = folder / "r.exr";
  const auto json = nlohmann::json::parse(runImporton({"compare", a, r, "--json"}).out);
  EXPECT_NEAR(json["band_rms"].get<double>(), 0.78 * 5 / std::numbers::sqrt2, 0.3);
  EXPECT_EQ(runImporton({"compare", a, r, "--max-band", "4"}).status, 0);
  EXPECT_EQ(runImporton({"compare", a, r, "--max-band", "1"}).status, 5);
}

/// 4 x 2 pixels from column x and row y of an image of 8 x 6, of which each has its own value.
std::string writePart(const TemporaryFolder& folder, const std::string& name, int x, int y, int width = 4,
                      int height = 2) {
  std::vector<float> values;
  for (int row = y; row < y + height; ++row)
    for (int column = x; column < x + width; ++column) values.push_back(static_cast<float>(1 + 8 * row + column));
  writeExr(folder / name, {width, height, {{"R", values}, {"G", values}, {"B", values}}, {}, {8, 6, x, y}});
  return folder / name;
}

TEST(Cli, CompareOfPartsIsOfWhatBothShow) {
  const TemporaryFolder folder;
  const std::string whole = writePart(folder, "whole.exr", 0, 0, 8, 6), part = writePart(folder, "part.exr", 3, 4),
                    beside = writePart(folder, "beside.exr", 2, 3), far = writePart(folder, "far.exr", 3, 0);
  for (const auto& [a, b] : {std::pair(part, whole), {whole, part}, {beside, part}}) {
    const Outcome outcome = runImporton({"compare", a, b, "--max-relmse", "0", "--diff", folder / "d.exr"});
    EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  }
  const Image shared = readExr(folder / "d.exr");
  EXPECT_EQ(shared.width, 3);
  EXPECT_EQ(shared.height, 1);
  EXPECT_EQ(shared.whole.x, 3);
  EXPECT_EQ(shared.whole.y, 4);
  const Outcome none = runImporton({"compare", far, part});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("share no pixel"), std::string::npos) << none.err;
}

TEST(Cli, CompareExceedsEveryLimitWithPixelsThatAreNotFinite) {
  const TemporaryFolder folder;
  const std::string a = writeGrey(folder, "a.exr", std::numeric_limits<float>::quiet_NaN());
  const Outcome outcome = runImporton({"compare", a, writeGrey(folder, "r.exr", 1), "--max-relmse", "1e300"});
  EXPECT_EQ(outcome.status, 5);
  EXPECT_NE(outcome.out.find("non-finite pixels: 8"), std::string::npos) << outcome.out;
}

TEST(Cli, CompareShowsTheDifference) {
  const TemporaryFolder folder;
  const std::string a = writeGrey(folder, "a.exr", 2), r = writeGrey(folder, "r.exr", 0.5F);
  const Outcome outcome = runImporton({"compare", a, r, "--diff", folder / "d.exr", "--diff-png", folder / "d.png"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(readExr(folder / "d.exr").find("R")->values, std::vector<float>(8, 1.5F));
  EXPECT_EQ(test::readFile(folder / "d.png").substr(1, 3), "PNG");
  EXPECT_EQ(runImporton({"compare", a, r, "--diff", folder / "no/d.exr"}).status, 4);
}

TEST(Cli, CompareReadsLayers) {
  const TemporaryFolder folder;
  Image image{4, 2, {}, {}};
  for (const char* name : {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"})
    image.channels.push_back({name, std::vector<float>(8, name[0] == 'a' ? 1.F : 2.F)});
  writeExr(folder / "l.exr", image);
  const std::string r = writeGrey(folder, "r.exr", 1);
  EXPECT_EQ(runImporton({"compare", folder / "l.exr", r}).status, 2);
  EXPECT_EQ(runImporton({"compare", folder / "l.exr", r, "--layer", "a", "--max-relmse", "0"}).status, 0);
  EXPECT_EQ(runImporton({"compare", folder / "l.exr", r, "--layer", "b", "--max-relmse", "0"}).status, 5);
  EXPECT_EQ(runImporton({"compare", r, folder / "l.exr", "--reference-layer", "a", "--max-flip-hdr", "0"}).status, 0);
}

TEST(Cli, CompareRefusesWhatCannotBeCompared) {
  const TemporaryFolder folder;
  const std::string r = writeGrey(folder, "r.exr", 1);
  EXPECT_EQ(runImporton({"compare", writeGrey(folder, "wide.exr", 1, 5), r}).status, 2);
  EXPECT_EQ(runImporton({"compare", folder / "none.exr", r}).status, 2);
  writeExr(folder / "depth.exr", {4, 2, {{"Z", std::vector<float>(8)}}, {}});
  EXPECT_EQ(runImporton({"compare", folder / "depth.exr", r}).status, 2);
  test::writeFile(folder / "text.exr", "no image");
  EXPECT_EQ(runImporton({"compare", r, folder / "text.exr"}).status, 2);
}

}  // namespace
}  // namespace importon
