// Renders that stop and go on, and runs that share an image.
#include <gtest/gtest.h>
#include <signal.h>

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
using test::writeFile;

const std::string kScenes = IMPORTON_SCENES;
const std::string kRing = kScenes + "/ring/ring.gltf";  // has caustics

std::vector<std::string> tiny(const std::string& scene, const std::string& output,
                              std::initializer_list<std::string> more) {
  std::vector<std::string> arguments{scene, "-o",        output, "--width",     "24",  "--height",
                                     "16",  "--photons", "4096", "--importons", "2048"};
  arguments.insert(arguments.end(), more);
  return arguments;
}

void expectStatus(const Outcome& outcome, int status) { ASSERT_EQ(outcome.status, status) << outcome.err; }

// The pause comes after paths were dealt by noise.
TEST(CliRender, ResumesToTheSameBits) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  expectStatus(runImporton(tiny(kRing, folder / "whole.exr", {"--passes", "7"})), 0);
  expectStatus(runImporton(tiny(kRing, folder / "part.exr", {"--passes", "5", "--checkpoint", state})), 0);
  expectStatus(
      runImporton(tiny(kRing, folder / "o.exr",
                       {"--passes", "7", "--resume", state, "--checkpoint", state, "--stats", folder / "o.json"})),
      0);
  EXPECT_EQ(readFile(folder / "o.exr"), readFile(folder / "whole.exr"));
  EXPECT_NE(readFile(folder / "part.exr"), readFile(folder / "whole.exr"));
  const auto stats = nlohmann::json::parse(readFile(folder / "o.json"));
  EXPECT_EQ(stats["image"]["passes"], 7);
  EXPECT_EQ(stats["photons"]["emitted"], 7 * 4096);
  // The checkpoint of the end gives the image again without a pass.
  expectStatus(runImporton(tiny(kRing, folder / "again.exr", {"--passes", "7", "--resume", state})), 0);
  EXPECT_EQ(readFile(folder / "again.exr"), readFile(folder / "whole.exr"));
}

TEST(CliRender, ResumesACropAndNoOther) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  const auto cropped = [&](const std::string& output, const std::string& x, std::initializer_list<std::string> more) {
    auto words = tiny(kCornellBox, output, more);
    words.insert(words.end(), {"--crop", x, "3", "12", "9"});
    return runImporton(words);
  };
  expectStatus(cropped(folder / "whole.exr", "4", {"--passes", "2"}), 0);
  expectStatus(cropped(folder / "part.exr", "4", {"--passes", "1", "--checkpoint", state}), 0);
  expectStatus(cropped(folder / "o.exr", "4", {"--passes", "2", "--resume", state}), 0);
  EXPECT_EQ(readFile(folder / "o.exr"), readFile(folder / "whole.exr"));
  EXPECT_NE(cropped(folder / "other.exr", "5", {"--passes", "2", "--resume", state}).status, 0);
}

// Where a run stops by its error depends on what it knew of it before.
TEST(CliRender, ResumesToTheSamePassByError) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  expectStatus(runImporton(tiny(kRing, folder / "whole.exr", {"--error", "0.1"})), 0);
  expectStatus(
      runImporton(tiny(kRing, folder / "part.exr", {"--error", "0.1", "--passes", "5", "--checkpoint", state})), 0);
  expectStatus(runImporton(tiny(kRing, folder / "o.exr", {"--error", "0.1", "--resume", state})), 0);
  EXPECT_GT(std::stoi(readExr(folder / "whole.exr").attributes.at("importon:passes")), 5);
  EXPECT_EQ(readFile(folder / "o.exr"), readFile(folder / "whole.exr"));
}

// What a lack of memory taught is part of the state.
TEST(CliRender, ResumesWithHarderControl) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  const auto arguments = [&](const std::string& output, std::initializer_list<std::string> more) {
    auto words = tiny(kCornellBox, output, more);
    words.insert(words.end(), {"--memory", "1", "--control", "off"});
    return words;
  };
  const Outcome whole = runImporton(arguments(folder / "whole.exr", {"--passes", "3"}));
  expectStatus(whole, 0);
  EXPECT_NE(whole.err.find("--memory"), std::string::npos) << whole.err;
  expectStatus(runImporton(arguments(folder / "part.exr", {"--passes", "2", "--checkpoint", state})), 0);
  expectStatus(runImporton(arguments(folder / "o.exr", {"--passes", "3", "--resume", state})), 0);
  EXPECT_EQ(readFile(folder / "o.exr"), readFile(folder / "whole.exr"));
}

TEST(CliRender, ResumesAfterAnInterrupt) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  const test::RunOptions interrupt{.hasTerminal = true, .onErr = [isSent = false](const std::string& err) mutable {
                                     if (isSent || err.find("pass 2/") == std::string::npos) return 0;
                                     isSent = true;
                                     return SIGINT;
                                   }};
  expectStatus(
      runImporton(tiny(kCornellBox, folder / "part.exr", {"--passes", "100000", "--checkpoint", state}), interrupt),
      130);
  const int done = std::stoi(readExr(folder / "part.exr").attributes.at("importon:passes"));
  const std::string all = std::to_string(done + 2);
  expectStatus(runImporton(tiny(kCornellBox, folder / "whole.exr", {"--passes", all})), 0);
  expectStatus(runImporton(tiny(kCornellBox, folder / "o.exr", {"--passes", all, "--resume", state})), 0);
  EXPECT_EQ(readFile(folder / "o.exr"), readFile(folder / "whole.exr"));
}

TEST(CliRender, RefusesACheckpointOfAnotherRun) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  expectStatus(runImporton(tiny(kCornellBox, folder / "a.exr", {"--passes", "1", "--checkpoint", state})), 0);
  for (const std::vector<std::string>& other : {std::vector<std::string>{"--seed", "1"}, {"--gather", "2"}}) {
    auto arguments = tiny(kCornellBox, folder / "b.exr", {"--passes", "2", "--resume", state});
    arguments.insert(arguments.end(), other.begin(), other.end());
    const Outcome outcome = runImporton(arguments);
    EXPECT_EQ(outcome.status, 2) << other[0];
    EXPECT_NE(outcome.err.find("of another run"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(runImporton(tiny(kRing, folder / "b.exr", {"--passes", "2", "--resume", state})).status, 2);
  EXPECT_EQ(folder.entries(), 2);
}

TEST(CliRender, RefusesATornCheckpoint) {
  const TemporaryFolder folder;
  const std::string state = folder / "state";
  expectStatus(runImporton(tiny(kCornellBox, folder / "a.exr", {"--passes", "1", "--checkpoint", state})), 0);
  writeFile(folder / "torn", readFile(state).substr(0, 10000));
  const Outcome outcome =
      runImporton(tiny(kCornellBox, folder / "b.exr", {"--passes", "2", "--resume", folder / "torn"}));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err.find("importon: error: the checkpoint is torn or damaged ("), 0u) << outcome.err;
}

TEST(CliRender, WritesTheImageThoughTheCheckpointFails) {
  const TemporaryFolder folder;
  const Outcome outcome =
      runImporton(tiny(kCornellBox, folder / "a.exr", {"--passes", "1", "--checkpoint", "/dev/full"}));
  EXPECT_EQ(outcome.status, 4);
  EXPECT_NE(outcome.err.find("cannot write"), std::string::npos) << outcome.err;
  EXPECT_EQ(readExr(folder / "a.exr").width, 24);
}

TEST(CliRender, MergesRunsOfDifferentSeeds) {
  const TemporaryFolder folder;
  expectStatus(runImporton(tiny(kCornellBox, folder / "a.exr", {"--passes", "3", "--seed", "1"})), 0);
  expectStatus(runImporton(tiny(kCornellBox, folder / "b.exr", {"--passes", "1", "--seed", "2"})), 0);
  expectStatus(runImporton({"merge", folder / "a.exr", folder / "b.exr", "-o", folder / "c.exr"}), 0);
  const Image a = readExr(folder / "a.exr"), b = readExr(folder / "b.exr"), c = readExr(folder / "c.exr");
  EXPECT_EQ(c.attributes.at("importon:seed"), "1 2");
  EXPECT_EQ(c.attributes.at("importon:passes"), "4");
  for (std::size_t i = 0; i < c.find("G")->values.size(); ++i) {
    const float expected = 0.75F * a.find("G")->values[i] + 0.25F * b.find("G")->values[i];
    EXPECT_NEAR(c.find("G")->values[i], expected, 1e-6F * expected) << i;
  }
  EXPECT_EQ(runImporton({"merge", folder / "a.exr", folder / "a.exr", "-o", folder / "d.exr"}).status, 2);
  EXPECT_EQ(runImporton({"merge", folder / "a.exr", "-o", folder / "d.exr"}).status, 1);
  EXPECT_EQ(folder.entries(), 3);
}

}  // namespace
}  // namespace importon
