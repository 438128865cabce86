// Whole renders by the binary, on the device.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::readFile;
using test::runImporton;
using test::TemporaryFolder;

const std::vector<std::string> kSmall{"--width", "32", "--height", "24"};

std::vector<std::string> smallRender(const std::string& output, std::initializer_list<std::string> more) {
  std::vector<std::string> arguments{kCornellBox, "-o", output};
  arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
  arguments.insert(arguments.end(), more);
  return arguments;
}

/// All finite, some of it lit.
void expectGoodImage(const std::filesystem::path& file) {
  const Image image = readExr(file);
  EXPECT_EQ(image.width, 32);
  EXPECT_EQ(image.height, 24);
  double sum = 0;
  for (const char* name : {"R", "G", "B"}) {
    const Channel* channel = image.find(name);
    ASSERT_NE(channel, nullptr) << name;
    for (const float value : channel->values) sum += static_cast<double>(value);
  }
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_GT(sum, 0);
}

TEST(CliRender, SmokeTakesAnEnvironmentMap) {
  const TemporaryFolder folder;
  const Image map{2, 1, {{"R", {1, 1}}, {"G", {2, 2}}, {"B", {3, 3}}}, {}};
  writeExr(folder / "sky.exr", map);
  const Outcome outcome =
      runImporton(smallRender(folder / "o.exr", {"--passes", "1", "--environment", folder / "sky.exr"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Outcome info = runImporton({"info", kCornellBox, "--environment", folder / "sky.exr"});
  EXPECT_NE(info.out.find("1 environment"), std::string::npos) << info.out;
  const Outcome missing =
      runImporton(smallRender(folder / "o.exr", {"--passes", "1", "--environment", folder / "no.exr"}));
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("no.exr"), std::string::npos) << missing.err;
  writeExr(folder / "dark.exr", Image{1, 1, {{"R", {-1}}, {"G", {0}}, {"B", {0}}}, {}});
  EXPECT_EQ(runImporton(smallRender(folder / "o.exr", {"--environment", folder / "dark.exr"})).status, 2);
}

/// A model as it comes: no light, no camera.
void writeBareModel(const std::string& file) {
  std::ofstream(file) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST(CliRender, SmokeShowsAModelThatHasNothingElse) {
  const TemporaryFolder folder;
  writeBareModel(folder / "m.gltf");
  std::vector<std::string> arguments{folder / "m.gltf", "-o", folder / "m.exr", "--png",          folder / "m.png",
                                     "--passes",        "1",  "--stats",        folder / "m.json"};
  arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
  const Outcome outcome = runImporton(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no light: it is lit by a studio"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("no camera"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 2) << outcome.err;
  expectGoodImage(folder / "m.exr");
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "m.json"))["light"], "studio");
  EXPECT_NE(runImporton({"info", folder / "m.gltf"}).out.find("the studio"), std::string::npos);
  EXPECT_NE(runImporton({"info", folder / "m.gltf", "--json"}).out.find("\"light\": \"studio\""), std::string::npos);
  arguments.insert(arguments.end(), {"--light", "scene"});
  EXPECT_EQ(runImporton(arguments).status, 2);
}

TEST(CliRender, SmokeWritesCoverageAsAlpha) {
  const TemporaryFolder folder;
  writeBareModel(folder / "m.gltf");
  std::vector<std::string> arguments{folder / "m.gltf", "-o", folder / "m.exr", "--passes", "1", "--transparent"};
  arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
  ASSERT_EQ(runImporton(arguments).status, 0);
  const Image image = readExr(folder / "m.exr");
  const Channel* alpha = image.find("A");
  ASSERT_NE(alpha, nullptr);
  EXPECT_EQ(std::ranges::count(alpha->values, 0.0f) > 0, true);
  EXPECT_EQ(std::ranges::count(alpha->values, 1.0f) > 0, true);
}

TEST(CliRender, SmokeTakesARadiancePictureAsEnvironment) {
  const TemporaryFolder folder;
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  std::ofstream(folder / "sky.hdr", std::ios::binary) << header << "\x20\x40\x60\x81\x20\x40\x60\x81";
  EXPECT_EQ(runImporton(smallRender(folder / "o.exr", {"--passes", "1", "--environment", folder / "sky.hdr"})).status,
            0);
  std::ofstream(folder / "cut.hdr", std::ios::binary) << header << "\x20";
  const Outcome cut = runImporton(smallRender(folder / "o.exr", {"--environment", folder / "cut.hdr"}));
  EXPECT_EQ(cut.status, 2);
  EXPECT_NE(cut.err.find("cut.hdr"), std::string::npos) << cut.err;
}

TEST(CliRender, SmokeWritesImagePreviewAndStats) {
  const TemporaryFolder folder;
  const Outcome outcome = runImporton(
      smallRender(folder / "o.exr", {"--passes", "2", "--png", folder / "o.png", "--stats", folder / "o.json"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.entries(), 3);
  expectGoodImage(folder / "o.exr");
  EXPECT_EQ(readFile(folder / "o.png").substr(1, 3), "PNG");
  const auto stats = nlohmann::json::parse(readFile(folder / "o.json"));
  EXPECT_EQ(stats["image"]["passes"], 2);
  EXPECT_EQ(stats["image"]["width"], 32);
  EXPECT_GT(stats["rays"]["closest"].get<double>(), 0);
  EXPECT_FALSE(stats["kernels"].empty());
  EXPECT_NE(stats["device"]["name"], "");
  EXPECT_GT(stats["seconds"]["total"].get<double>(), 0);
  EXPECT_GT(stats["memory"]["host_peak_bytes"].get<double>(), 1e6);
}

TEST(CliRender, LookChangesThePngAlone) {
  const TemporaryFolder folder;
  for (const std::string map : {"neutral", "agx"})
    ASSERT_EQ(runImporton(smallRender(folder / (map + ".exr"), {"--passes", "1", "--png", folder / (map + ".png"),
                                                                "--tone-map", map, "--exposure", "1"}))
                  .status,
              0);
  EXPECT_EQ(readFile(folder / "agx.exr"), readFile(folder / "neutral.exr"));
  EXPECT_NE(readFile(folder / "agx.png"), readFile(folder / "neutral.png"));
  const Outcome unused = runImporton(smallRender(folder / "o.exr", {"--passes", "1", "--exposure", "1"}));
  EXPECT_EQ(unused.status, 0);
  EXPECT_NE(unused.err.find("--exposure is of the PNG"), std::string::npos) << unused.err;
  EXPECT_EQ(runImporton(smallRender(folder / "p.exr", {"--exposure", "bright"})).status, 1);
}

TEST(CliRender, MeasuresTheErrorAfterEachPass) {
  const TemporaryFolder folder;
  ASSERT_EQ(runImporton(smallRender(folder / "r.exr", {"--passes", "3", "--seed", "2"})).status, 0);
  ASSERT_EQ(runImporton(smallRender(folder / "o.exr",
                                    {"--passes", "3", "--reference", folder / "r.exr", "--stats", folder / "o.json"}))
                .status,
            0);
  const auto json = nlohmann::json::parse(readFile(folder / "o.json"));
  const auto& points = json["error"]["passes"];
  ASSERT_EQ(points.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(points[i]["pass"], i + 1);
    EXPECT_GT(points[i]["relmse"], 0);
  }
  EXPECT_LT(points[0]["seconds"], points[2]["seconds"]);
  const Outcome compared = runImporton({"compare", folder / "o.exr", folder / "r.exr", "--json"});
  const auto expected = nlohmann::json::parse(compared.out);
  for (const char* metric : {"relmse", "relmse_trimmed", "smape"}) {
    EXPECT_EQ(json["error"][metric], expected[metric]) << metric;
    EXPECT_EQ(points[2][metric], expected[metric]) << metric;
  }
  EXPECT_EQ(json["error"]["band"], expected["band_rms"]);
}

TEST(CliRender, KeepsATimeBudget) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(
      runImporton(smallRender(folder / "o.exr", {"--time", "6", "--photons", "4096", "--stats", folder / "o.json"}))
          .status,
      0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_NEAR(seconds, 6, 1);
  const auto json = nlohmann::json::parse(readFile(folder / "o.json"));
  EXPECT_GT(json["image"]["passes"], 1);
  EXPECT_LT(json["error"]["low"], json["error"]["estimated"]);
  EXPECT_GT(json["error"]["high"], json["error"]["estimated"]);
}

TEST(CliRender, RefusesAReferenceOfAnotherSize) {
  const TemporaryFolder folder;
  ASSERT_EQ(runImporton(smallRender(folder / "r.exr", {"--passes", "1"})).status, 0);
  const Outcome outcome = runImporton(
      {kCornellBox, "-o", folder / "o.exr", "--width", "16", "--height", "12", "--reference", folder / "r.exr"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("32 x 24"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.entries(), 1);
}

TEST(CliRender, WritesACropInItsPlace) {
  const TemporaryFolder folder;
  const std::initializer_list<std::string> whole{"--passes", "1", "--integrator", "path"};
  ASSERT_EQ(runImporton(smallRender(folder / "whole.exr", whole)).status, 0);
  const auto cropped = [&](const std::string& output, std::initializer_list<std::string> more) {
    std::vector<std::string> words = smallRender(output, whole);
    words.insert(words.end(), {"--crop", "20", "2", "10", "8"});
    words.insert(words.end(), more);
    return runImporton(words);
  };
  const Outcome outcome = cropped(folder / "part.exr", {"--png", folder / "part.png", "--reference",
                                                        folder / "whole.exr", "--stats", folder / "part.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Image part = readExr(folder / "part.exr");
  EXPECT_EQ(part.width, 10);
  EXPECT_EQ(part.height, 8);
  EXPECT_EQ(part.whole.width, 32);
  EXPECT_EQ(part.whole.height, 24);
  EXPECT_EQ(part.whole.x, 20);
  EXPECT_EQ(part.whole.y, 2);
  EXPECT_EQ(readFile(folder / "part.png").substr(16, 8), std::string("\0\0\0\12\0\0\0\10", 8)) << "10 x 8 pixels";
  EXPECT_EQ(runImporton({"compare", folder / "part.exr", folder / "whole.exr", "--max-relmse", "0"}).status, 0);
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "part.json"))["error"]["relmse"], 0) << "against the whole image";
  EXPECT_EQ(cropped(folder / "o.exr", {"--reference", folder / "part.exr"}).status, 0) << "against the crop";
  // Of another size, of another place, and a crop that is not within the image.
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--crop", "20", "2", "10", "9", "--reference", folder / "part.exr"},
        {"--crop", "19", "2", "10", "8", "--reference", folder / "part.exr"},
        {"--crop", "23", "2", "10", "8"},
        {"--crop", "20", "17", "10", "8"}}) {
    std::vector<std::string> words = smallRender(folder / "bad.exr", whole);
    words.insert(words.end(), more.begin(), more.end());
    const Outcome refused = runImporton(words);
    EXPECT_EQ(refused.status, 1) << refused.err;
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "bad.exr"));
  }
}

TEST(CliRender, ConvergesAndWritesThePage) {
  const TemporaryFolder folder;
  // With the kernels that are asked for below, so that a driver has them.
  ASSERT_EQ(runImporton(smallRender(folder / "r.exr", {"--passes", "2", "--seed", "9", "--control", "off"})).status, 0);
  const Outcome outcome = runImporton({"converge", kCornellBox, "--reference", folder / "r.exr", "-o", folder / "out",
                                       "--configs", "uncontrolled", "--times", "8", "--seeds", "1", "--width", "32",
                                       "--height", "24", "--photons", "4096"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const auto json = nlohmann::json::parse(readFile(folder / "out/results.json"));
  ASSERT_EQ(json["configs"].size(), 1u);
  const auto& points = json["configs"][0]["runs"][0]["points"];
  ASSERT_EQ(points.size(), 1u);
  EXPECT_GT(points[0]["relmse_trimmed"], 0);
  EXPECT_LE(points[0]["photons_emitted"], 4096 * points[0]["passes"].get<int>());
  EXPECT_GE(points[0]["photons_emitted"], 1024 * points[0]["passes"].get<int>());  // the first passes are smaller
  EXPECT_EQ(readFile(folder / "out/results.csv").substr(0, 12), "config,seed,");
  EXPECT_EQ(readFile(folder / "out/index.html").substr(0, 15), "<!DOCTYPE html>");
}

TEST(CliRender, ListsTheDevice) {
  const Outcome outcome = runImporton({"devices"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("* "), std::string::npos) << outcome.out;
}

TEST(CliRender, GivesTheSameBytesForTheSameSeed) {
  const TemporaryFolder folder;
  for (const char* name : {"a.exr", "b.exr"}) {
    ASSERT_EQ(runImporton(smallRender(folder / name, {"--passes", "2", "--seed", "7"})).status, 0);
  }
  ASSERT_EQ(runImporton(smallRender(folder / "c.exr", {"--passes", "2", "--seed", "8"})).status, 0);
  EXPECT_EQ(readFile(folder / "a.exr"), readFile(folder / "b.exr"));
  EXPECT_NE(readFile(folder / "a.exr"), readFile(folder / "c.exr"));
}

/// lavapipe takes the number of its threads from the environment; other drivers pass over it.
TEST(CliRender, GivesTheSameBytesForAnyNumberOfDriverThreads) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "2", "8"}) {
    const Outcome outcome = runImporton(smallRender(folder / (std::string(threads) + ".exr"), {"--passes", "2"}),
                                        {.environment = {{"LP_NUM_THREADS", threads}}});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(readFile(folder / (std::string(threads) + ".exr")), readFile(folder / "1.exr"));
  }
}

TEST(CliRender, SaysNothingWhenQuiet) {
  const TemporaryFolder folder;
  const Outcome outcome = runImporton(smallRender(folder / "o.exr", {"--passes", "1", "-q"}));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST(CliRender, ShowsProgressOnATerminalOnly) {
  const TemporaryFolder folder;
  const auto arguments = smallRender(folder / "o.exr", {"--passes", "2"});
  EXPECT_NE(runImporton(arguments, {.hasTerminal = true}).err.find("pass 1/2"), std::string::npos);
  EXPECT_EQ(runImporton(arguments).err.find("pass 1/2"), std::string::npos);
}

TEST(CliRender, AnUnknownDeviceIsADeviceError) {
  const TemporaryFolder folder;
  const Outcome outcome = runImporton(smallRender(folder / "o.exr", {"--device", "no such device"}));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("importon: error: "), std::string::npos);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(CliRender, AnUnknownCameraIsAnErrorThatLeavesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = runImporton(smallRender(folder / "o.exr", {"--camera", "no such camera"}));
  EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status;
  EXPECT_NE(outcome.err.find("importon: error: "), std::string::npos);
  EXPECT_EQ(folder.entries(), 0);
}

/// Sends `signal` once, after the first pass.
test::RunOptions interruptedBy(int signal) {
  return {.hasTerminal = true, .onErr = [signal, isSent = false](const std::string& err) mutable {
            if (isSent || err.find("pass 1/") == std::string::npos) return 0;
            isSent = true;
            return signal;
          }};
}

TEST(CliRender, WritesTheImageSoFarWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const auto arguments = smallRender(folder / "o.exr", {"--passes", "1000000", "--stats", folder / "o.json"});
    const Outcome outcome = runImporton(arguments, interruptedBy(signal));
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    expectGoodImage(folder / "o.exr");
    EXPECT_GE(nlohmann::json::parse(readFile(folder / "o.json"))["image"]["passes"], 1);
    EXPECT_EQ(folder.entries(), 2);
  }
}

TEST(CliRender, EndsAtOnceOnTheSecondInterrupt) {
  const TemporaryFolder folder;
  int sent = 0;
  const auto onErr = [&sent](const std::string& err) {
    const bool isDue =
        sent == 0 ? err.find("pass 1/") != std::string::npos : sent == 1 && err.find("once more") != std::string::npos;
    if (!isDue) return 0;
    ++sent;
    return SIGINT;
  };
  const Outcome outcome = runImporton(smallRender(folder / "o.exr", {"--passes", "1000000", "--photons", "300000"}),
                                      {.hasTerminal = true, .onErr = onErr});
  EXPECT_EQ(sent, 2);
  // Whichever comes first: the signal, or the end of the pass.
  EXPECT_TRUE(outcome.signal == SIGINT || outcome.status == 130) << outcome.status;
  EXPECT_EQ(std::filesystem::exists(folder / "o.exr"), outcome.signal == 0);
}

}  // namespace
}  // namespace importon
