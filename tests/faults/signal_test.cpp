// SIGINT and SIGTERM at any moment: an orderly end, with a whole image or none.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
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
  return test::runImporton({kCornellBox, "-o", folder / "o.exr", "--png", folder / "o.png", "--width", "32", "--height", "24",
                            "--photons", "4096", "--importons", "2048", "--passes", "1000000"},
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

}  // namespace
}  // namespace importon
