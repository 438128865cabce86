// Sequences: what they refuse, and what they make on the device.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/program.h"
#include "io/image.h"
#include "loader/animation_builder.h"
#include "support/temporary_folder.h"

namespace importon::sequence_cli_test {
namespace {

using test::GltfBuilder;
using test::kCornellBox;
using test::Outcome;
using test::readFile;
using test::runImporton;
using test::RunOptions;
using test::TemporaryFolder;
using test::writeFile;

/// A glowing triangle that moves to the side, with a camera of the file's own or none.
std::string movingTriangle(bool hasCamera) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  test::addMove(builder, 0, {0, 0, 0}, {1, 0, 0});
  builder.json["animations"][0]["name"] = "slide";
  if (hasCamera) {
    builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    builder.addRoot({{"camera", 0}, {"translation", {0.5, 0.5, 3}}});
  }
  const test::Bytes bytes = builder.glb();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// One line with all `parts`, and nothing on stdout.
void expectRefusal(const Outcome& outcome, int status, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.find("importon: error: "), 0u) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  for (const std::string& part : parts) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

class SequenceTest : public testing::Test {
 protected:
  [[nodiscard]] Outcome run(std::vector<std::string> arguments, const RunOptions& options = {}) const {
    arguments.insert(arguments.end(), {"--width", "32", "--height", "24", "--photons", "4096", "--importons", "2048"});
    return runImporton(arguments, options);
  }
  std::string makeScene(bool hasCamera) const {
    writeFile(folder_ / "a.glb", movingTriangle(hasCamera));
    return folder_ / "a.glb";
  }
  [[nodiscard]] std::string made(const std::string& name) const { return readFile(folder_ / name); }
  [[nodiscard]] bool isMade(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  TemporaryFolder folder_;
};

using CliSequence = SequenceTest;
using CliSequenceRender = SequenceTest;

TEST_F(CliSequence, NeedsNamesWithOneNumber) {
  const std::string box = kCornellBox, good = folder_ / "%04d.exr";
  const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& parts) {
    more.insert(more.begin(), box);
    for (const auto& sequence : {std::vector<std::string>{"--frames", "0..3"}, {"--turntable", "4"}}) {
      std::vector<std::string> arguments = more;
      arguments.insert(arguments.end(), sequence.begin(), sequence.end());
      expectRefusal(runImporton(arguments), 1, parts);
    }
  };
  refused({"-o", folder_ / "a.exr"}, {"--output names one file", "a.exr", "%04d"});
  refused({"-o", folder_ / "%d_%d.exr"}, {"more than one number"});
  refused({"-o", folder_ / "%s.exr"}, {"\"%s\""});
  refused({"-o", folder_ / "%d/a.exr"}, {"--output"});
  refused({"-o", good, "--png", folder_ / "a.png"}, {"--png names one file"});
  refused({"-o", good, "--reference", folder_ / "r.exr"}, {"--reference names one file"});
  refused({"-o", good, "--stats", folder_ / "%d%d.json"}, {"--stats", "more than one number"});
  refused({"-o", folder_ / "f%d.png", "--png", folder_ / "f%1d.png"}, {"\"%1\""});
  refused({"-o", folder_ / "f%d.png", "--png", folder_ / "f%01d.png"}, {"the same name", "f0.png"});
  EXPECT_EQ(folder_.entries(), 0);
}

TEST_F(CliSequence, RefusesRangesThatAreNone) {
  for (const char* range : {"3..2", "3", "..", "1..", "..2", "-1..2", "a..b", "1...3", "0..1.5", "0..100000", "+0..1",
                            "0..99999999999999999999", " 0..1"})
    expectRefusal(runImporton({kCornellBox, "-o", "%d.exr", "--frames", range}), 1, {"--frames", range});
  expectRefusal(runImporton({kCornellBox, "-o", "%d.exr", "--turntable", "0"}), 1, {"--turntable"});
  expectRefusal(runImporton({kCornellBox, "-o", "%d.exr", "--frames", "0..1", "--fps", "0"}), 1, {"--fps"});
}

TEST_F(CliSequence, RefusesWhatContradictsIt) {
  const std::vector<std::string> frames{kCornellBox, "-o", "%d.exr", "--frames", "0..1"};
  const auto refused = [&](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
    std::vector<std::string> arguments = frames;
    arguments.insert(arguments.end(), more.begin(), more.end());
    expectRefusal(runImporton(arguments), 1, parts);
  };
  refused({"--at", "1"}, {"--frames", "--at"});
  refused({"--checkpoint", "c"}, {"--checkpoint", "--skip-existing"});
  refused({"--resume", "c"}, {"--resume"});
  refused({"--camera", "all"}, {"one scene and one camera"});
  refused({"--list", "jobs"}, {"one scene and one camera"});
  refused({"b.glb"}, {"one scene and one camera"});
  const auto without = [&](const std::string& option, const std::string& value) {
    std::vector<std::string> arguments{kCornellBox, "-o", "o.exr", option};
    if (!value.empty()) arguments.push_back(value);
    expectRefusal(runImporton(arguments), 1, {option + " needs", "--frames"});
  };
  without("--fps", "24");
  without("--skip-existing", "");
  without("--seed-per-frame", "");
  without("--animation", "0");
  writeFile(folder_ / "jobs", "a.glb --turntable 3\n");
  expectRefusal(runImporton({"--list", folder_ / "jobs", "-o", folder_ / "out"}), 1, {"--turntable", "jobs:1"});
}

TEST_F(CliSequence, RefusesAFolderThatCannotBeWrittenBeforeItReadsTheScene) {
  writeFile(folder_ / "file", "");
  expectRefusal(runImporton({"none.glb", "-o", folder_ / "file/%d.exr", "--frames", "0..3"}), 4, {"folder", "file"});
  expectRefusal(
      runImporton({"none.glb", "-o", folder_ / "%d.exr", "--frames", "0..3", "--stats", folder_ / "no/%d.json"}), 4,
      {"create the folder"});
  if (geteuid() == 0) return;  // may write anywhere
  std::filesystem::create_directory(folder_ / "shut");
  std::filesystem::permissions(folder_ / "shut", std::filesystem::perms::owner_read);
  expectRefusal(runImporton({"none.glb", "-o", folder_ / "shut/%d.exr", "--frames", "0..3"}), 4, {"may write"});
}

TEST_F(CliSequence, SaysOnceWhatIsWrongWithEachFrame) {
  const Outcome outcome = runImporton({folder_ / "none.glb", "-o", folder_ / "%d.exr", "--frames", "0..9"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err.find("importon: error: the file does not exist"), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("0 of 10 pictures"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 2) << outcome.err;
  const Outcome other =
      runImporton({makeScene(true), "-o", folder_ / "%d.exr", "--frames", "0..9", "--animation", "run"});
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("no animation 'run'"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("slide"), std::string::npos) << other.err;
  EXPECT_EQ(std::ranges::count(other.err, '\n'), 2) << other.err;
}

TEST_F(CliSequenceRender, SmokeHasTheBitsOfEachPoseAlone) {
  const std::string scene = makeScene(true);
  const Outcome outcome = run({scene, "-o", folder_ / "out/f.%03d.exr", "--png", folder_ / "out/f.%03d.png", "--frames",
                               "1..3", "--fps", "4", "--passes", "1", "--stats", folder_ / "s.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("out/f.002.exr in "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(", 2/3"), std::string::npos) << outcome.err;
  for (const auto& [frame, time] : {std::pair("001", "0.25"), {"002", "0.5"}, {"003", "0.75"}}) {
    ASSERT_EQ(
        run({scene, "-o", folder_ / "one.exr", "--png", folder_ / "one.png", "--at", time, "--passes", "1"}).status, 0);
    for (const std::string end : {".exr", ".png"})
      EXPECT_EQ(made("out/f." + std::string(frame) + end), made("one" + end)) << frame;
  }
  EXPECT_NE(made("out/f.001.exr"), made("out/f.003.exr"));
  const auto summary = nlohmann::json::parse(made("s.json"));
  EXPECT_EQ(summary["pictures"], 3);
  ASSERT_EQ(summary["jobs"].size(), 3u);
  EXPECT_EQ(summary["jobs"][2]["frame"], 3);
  EXPECT_EQ(summary["jobs"][2]["output"], (folder_ / "out/f.003.exr").string());
}

TEST_F(CliSequenceRender, HasTwentyFourFramesASecondAndStatisticsOfEach) {
  const std::string scene = makeScene(true);
  ASSERT_EQ(
      run({scene, "-o", folder_ / "%d.exr", "--frames", "12..12", "--passes", "1", "--stats", folder_ / "s%d.json"})
          .status,
      0);
  ASSERT_EQ(run({scene, "-o", folder_ / "one.exr", "--at", "0.5", "--passes", "1"}).status, 0);
  EXPECT_EQ(made("12.exr"), made("one.exr"));
  EXPECT_EQ(nlohmann::json::parse(made("s12.json"))["image"]["passes"], 1);
}

TEST_F(CliSequenceRender, SharesDeviceAndKernels) {
  const std::string scene = makeScene(true);
  const RunOptions watched{
      .environment = {{"LD_PRELOAD", IMPORTON_WATCHED_DEVICE}, {"IMPORTON_TEST_COUNTS", folder_ / "counts"}}};
  int devices = 0, pipelines = 0, morePipelines = 0;
  ASSERT_EQ(run({scene, "-o", folder_ / "one.exr", "--at", "0", "--passes", "1"}, watched).status, 0);
  std::istringstream(made("counts")) >> devices >> pipelines;
  for (const std::vector<std::string>& sequence :
       {std::vector<std::string>{"--frames", "0..3"}, {"--turntable", "4"}}) {
    std::vector<std::string> arguments{scene, "-o", folder_ / "%d.exr", "--passes", "1"};
    arguments.insert(arguments.end(), sequence.begin(), sequence.end());
    ASSERT_EQ(run(arguments, watched).status, 0);
    std::istringstream(made("counts")) >> devices >> morePipelines;
    EXPECT_EQ(devices, 1);
    EXPECT_EQ(morePipelines, pipelines);
  }
}

/// From where the scene was framed at 0 s, whatever frames are made.
TEST_F(CliSequenceRender, CameraOfOurOwnStandsStill) {
  const std::string scene = makeScene(false);
  ASSERT_EQ(run({scene, "-o", folder_ / "at0.exr", "--at", "0", "--passes", "1"}).status, 0);
  ASSERT_EQ(run({scene, "-o", folder_ / "a%d.exr", "--frames", "0..1", "--fps", "1", "--passes", "1"}).status, 0);
  ASSERT_EQ(run({scene, "-o", folder_ / "b%d.exr", "--frames", "1..1", "--fps", "1", "--passes", "1"}).status, 0);
  EXPECT_EQ(made("a0.exr"), made("at0.exr"));
  EXPECT_EQ(made("a1.exr"), made("b1.exr"));
  const auto litColumns = [&](const std::string& name) {
    const Image image = readExr(folder_ / name);
    double sum = 0, count = 0;
    for (int i = 0; i < image.width * image.height; ++i) {
      if (image.find("G")->values[static_cast<std::size_t>(i)] < 0.5F) continue;
      sum += i % image.width;
      ++count;
    }
    return sum / count;
  };
  EXPECT_GT(litColumns("a1.exr"), litColumns("a0.exr") + 3) << "the triangle went to the right";
}

TEST_F(CliSequenceRender, TurntableGoesAroundWhatTheCameraSees) {
  const std::string scene = makeScene(true);
  ASSERT_EQ(run({scene, "-o", folder_ / "one.exr", "--passes", "1"}).status, 0);
  ASSERT_EQ(run({scene, "-o", folder_ / "t%d.exr", "--turntable", "8", "--passes", "1"}).status, 0);
  EXPECT_EQ(made("t0.exr"), made("one.exr"));
  // The same by a node above the camera, whose line of sight meets the scene's middle at (0.5, 0.5, 0).
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  const int camera = builder.add("nodes", {{"camera", 0}, {"translation", {0, 0, 3}}});
  const double half = std::numbers::pi / 8;  // of an eighth of a turn
  builder.addRoot(
      {{"translation", {0.5, 0.5, 0}}, {"rotation", {0, std::sin(half), 0, std::cos(half)}}, {"children", {camera}}});
  const test::Bytes bytes = builder.glb();
  writeFile(folder_ / "b.glb", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  ASSERT_EQ(run({folder_ / "b.glb", "-o", folder_ / "b.exr", "--passes", "1"}).status, 0);
  const Image turned = readExr(folder_ / "t1.exr"), other = readExr(folder_ / "b.exr");
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < other.find("G")->values.size(); ++i) {
    difference += std::abs(turned.find("G")->values[i] - other.find("G")->values[i]);
    sum += other.find("G")->values[i];
  }
  EXPECT_GT(sum, 10);
  EXPECT_LE(difference, 0.02 * sum);
  EXPECT_EQ(std::ranges::count(std::vector{made("t1.exr"), made("t2.exr"), made("t3.exr")}, made("t0.exr")), 0);
}

TEST_F(CliSequenceRender, HasASeedOfItsOwnInEachFrameIfAskedFor) {
  const std::string scene = makeScene(true);
  const auto render = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {scene, "--turntable", "2", "--passes", "1", "--seed", "4294967295"});
    ASSERT_EQ(run(more).status, 0);
  };
  render({"-o", folder_ / "same%d.exr"});
  render({"-o", folder_ / "own%d.exr", "--seed-per-frame"});
  EXPECT_EQ(readExr(folder_ / "same1.exr").attributes.at("importon:seed"), "4294967295");
  EXPECT_EQ(made("own0.exr"), made("same0.exr"));
  EXPECT_EQ(readExr(folder_ / "own1.exr").attributes.at("importon:seed"), "0") << "it begins anew after the last";
}

TEST_F(CliSequenceRender, LeavesFramesAloneThatAreThere) {
  const std::string scene = makeScene(true);
  const std::vector<std::string> arguments{scene,      "-o",   folder_ / "%d.exr", "--png",    folder_ / "%d.png",
                                           "--frames", "0..3", "--skip-existing",  "--passes", "1"};
  writeFile(folder_ / "0.exr", "made");
  writeFile(folder_ / "0.png", "made");
  writeFile(folder_ / "2.exr", "half made: without the preview");
  const Outcome outcome = run(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 of 4 frames are there"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("3 of 3 pictures"), std::string::npos) << outcome.err;
  EXPECT_EQ(made("0.exr"), "made");
  for (const char* name : {"1.exr", "2.exr", "3.exr"}) EXPECT_GT(made(name).size(), 500u) << name;
  const Outcome again = run(arguments);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("4 of 4 frames are there"), std::string::npos) << again.err;
  ASSERT_EQ(run({scene, "-o", folder_ / "%d.exr", "--frames", "0..0", "--passes", "1"}).status, 0);
  EXPECT_NE(made("0.exr"), "made") << "without the option a frame is made anew";
  writeFile(folder_ / "t0.exr", "made");
  ASSERT_EQ(run({scene, "-o", folder_ / "t%d.exr", "--turntable", "2", "--skip-existing", "--passes", "1"}).status, 0);
  EXPECT_EQ(made("t0.exr"), "made");
  EXPECT_TRUE(isMade("t1.exr"));
}

TEST_F(CliSequenceRender, WritesNoFrameThatWasInterrupted) {
  const auto onErr = [isSent = false](const std::string& err) mutable {
    if (isSent || err.find("pass 1/") == std::string::npos) return 0;
    isSent = true;
    return SIGINT;
  };
  const Outcome outcome = run({makeScene(true), "-o", folder_ / "%d.exr", "--frames", "0..3", "--passes", "1000000"},
                              {.hasTerminal = true, .onErr = onErr});
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("this frame is not written"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("0 of 4 pictures"), std::string::npos) << outcome.err;
  EXPECT_FALSE(isMade("0.exr"));
}

TEST_F(CliSequenceRender, WarnsOnceOfAFileWithoutAnimations) {
  const Outcome outcome = run({kCornellBox, "-o", folder_ / "%d.exr", "--frames", "0..2", "--passes", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::size_t first = outcome.err.find("nothing moves");
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("nothing moves", first + 1), std::string::npos) << outcome.err;
  EXPECT_EQ(made("0.exr"), made("2.exr"));
}

}  // namespace
}  // namespace importon::sequence_cli_test
