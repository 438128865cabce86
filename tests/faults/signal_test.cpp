// SIGINT and SIGTERM at any moment: an orderly end, with a whole image or none.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::TemporaryFolder;

/// Renders without end; sends `signal` after `delay`.
Outcome interruptedAfter(std::chrono::milliseconds delay, int signal, const TemporaryFolder& folder) {
  test::RunOptions options;
  options.delayedSignal = {signal, delay};
  return test::runImporton({kCornellBox, "-o", folder / "o.exr", "--png", folder / "o.png", "--width", "32", "--height",
                            "24", "--photons", "4096", "--importons", "2048", "--passes", "1000000"},
                           options);
}

void expectOrderlyEnd(const Outcome& outcome, const TemporaryFolder& folder) {
  if (outcome.signal != 0) {  // before the program listens
    EXPECT_EQ(folder.entries(), 0);
    return;
  }
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  if (outcome.err.find("no image is written") != std::string::npos) {
    EXPECT_EQ(folder.entries(), 0);
    return;
  }
  EXPECT_EQ(readExr(folder / "o.exr").height, 24);
  EXPECT_EQ(test::readFile(folder / "o.png").substr(1, 3), "PNG");
  EXPECT_EQ(folder.entries(), 2);
}

void interruptAtRandom(int count, unsigned seed, int mostMilliseconds) {
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) {
    const TemporaryFolder folder;
    const std::chrono::milliseconds delay(std::uniform_int_distribution<int>(0, mostMilliseconds)(random));
    const Outcome outcome = interruptedAfter(delay, i % 2 == 0 ? SIGINT : SIGTERM, folder);
    SCOPED_TRACE(testing::Message() << "signal after " << delay.count() << " ms");
    expectOrderlyEnd(outcome, folder);
  }
}

TEST(Signals, EndARenderInOrder) { interruptAtRandom(2, 1, 500); }

TEST(Signals, SlowAtAnyMomentEndARenderInOrder) { interruptAtRandom(20, 2, 4000); }

/// True from when the program has begun to write its `number`th file, which has a temporary name until it is whole.
bool isWriting(const TemporaryFolder& folder, int number) {
  const std::string end = "-" + std::to_string(number) + ".tmp";
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path(), gone))
    if (entry.path().string().ends_with(end)) return true;
  return false;
}

constexpr int kWideImage = 1000;

/// One pass of a wide image with a checkpoint and a preview; sends SIGTERM `times` times once file `number` is begun.
Outcome interruptedWhileWriting(int number, int times, const TemporaryFolder& folder) {
  int sent = 0;
  test::RunOptions options;
  options.onTick = [&] { return sent < times && (sent > 0 || isWriting(folder, number)) ? (++sent, SIGTERM) : 0; };
  const Outcome outcome =
      test::runImporton({kCornellBox, "-o", folder / "o.exr", "--png", folder / "o.png", "--checkpoint",
                         folder / "o.state", "--integrator", "path", "--max-depth", "1", "--width",
                         std::to_string(kWideImage), "--height", "800", "--passes", "1"},
                        options);
  EXPECT_EQ(sent, times) << "file " << number << " was never seen";
  return outcome;
}

/// The first three files only try whether the outputs can be written.
constexpr int kCheckpoint = 3, kPreview = 5;  // the image between them

TEST(Signals, SlowWhileAFileIsWrittenLeaveWholeFiles) {
  for (int number = kCheckpoint; number <= kPreview; ++number) {
    const TemporaryFolder folder;
    const Outcome outcome = interruptedWhileWriting(number, 1, folder);
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 130) << outcome.status << outcome.err;
    EXPECT_EQ(readExr(folder / "o.exr").width, kWideImage);
    EXPECT_EQ(folder.entries(), 3);
  }
}

TEST(Signals, SlowTwiceWhileAFileIsWrittenTearNone) {
  for (int number = kCheckpoint; number <= kPreview; ++number) {
    const TemporaryFolder folder;
    const Outcome outcome = interruptedWhileWriting(number, 2, folder);
    EXPECT_TRUE(outcome.signal == SIGTERM || outcome.status == 0 || outcome.status == 130) << outcome.status;
    if (std::filesystem::exists(folder / "o.exr")) {
      EXPECT_EQ(readExr(folder / "o.exr").width, kWideImage);
    }
    if (std::filesystem::exists(folder / "o.png")) {
      EXPECT_EQ(test::readFile(folder / "o.png").substr(1, 3), "PNG");
    }
    if (!std::filesystem::exists(folder / "o.state")) continue;
    const Outcome more = test::runImporton({kCornellBox, "-o", folder / "p.exr", "--resume", folder / "o.state",
                                            "--integrator", "path", "--max-depth", "1", "--width",
                                            std::to_string(kWideImage), "--height", "800", "--passes", "1"});
    EXPECT_EQ(more.status, 0) << more.err;
  }
}

/// A scene whose tree takes seconds to build: so many triangles by chance.
void writeCrowd(const TemporaryFolder& folder, unsigned triangles) {
  std::mt19937 random(1);
  std::ofstream bin(folder / "crowd.bin", std::ios::binary);
  for (unsigned i = 0; i < 9 * triangles; ++i) {
    const float coordinate = static_cast<float>(random() % 1'000'000) * 1e-6f;
    bin.write(reinterpret_cast<const char*>(&coordinate), sizeof coordinate);
  }
  const std::string bytes = std::to_string(36 * triangles), vertices = std::to_string(3 * triangles);
  test::writeFile(folder / "crowd.gltf",
                  R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"scenes":[{"nodes":[0,1]}],)"
                  R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},"nodes":[{"mesh":0},)"
                  R"({"extensions":{"KHR_lights_punctual":{"light":0}}}],"meshes":[{"primitives":[{"attributes":)"
                  R"({"POSITION":0}}]}],"buffers":[{"uri":"crowd.bin","byteLength":)" +
                      bytes + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + bytes +
                      R"(}],"accessors":[{"bufferView":0,"type":"VEC3","componentType":5126,"count":)" + vertices +
                      R"(,"min":[0,0,0],"max":[1,1,1]}]})");
}

TEST(Signals, SlowWhileTheTreeIsBuiltWriteNothing) {
  const TemporaryFolder folder;
  writeCrowd(folder, 5'000'000);
  for (const int signal : {SIGINT, SIGTERM}) {
    bool isSent = false;
    test::RunOptions options;
    options.hasTerminal = true;
    options.onErr = [&](const std::string& err) {
      if (isSent || err.find("building the BVH") == std::string::npos) return 0;
      isSent = true;
      return signal;
    };
    const Outcome outcome = test::runImporton({folder / "crowd.gltf", "-o", folder / "o.exr", "--width", "16",
                                               "--height", "16", "--integrator", "path", "--passes", "1"},
                                              options);
    EXPECT_TRUE(isSent) << outcome.err;
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_EQ(folder.entries(), 2);
  }
}

}  // namespace
}  // namespace importon
