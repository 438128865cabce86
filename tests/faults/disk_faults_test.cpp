// Disks that are full and folders that go away: exit status 4, and no torn file.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;

std::vector<std::string> smallRender(const std::string& output, std::initializer_list<std::string> more) {
  std::vector<std::string> arguments{kCornellBox, "-o",        output, "--width",     "64",  "--height",
                                     "48",        "--photons", "4096", "--importons", "2048"};
  arguments.insert(arguments.end(), more);
  return arguments;
}

TEST(DiskFaults, AFullDiskIsAnOutputError) {
  const TemporaryFolder folder;
  const Outcome image = runImporton(smallRender("/dev/full", {"--passes", "1"}));
  EXPECT_EQ(image.status, 4) << image.err;
  EXPECT_NE(image.err.find("free some space"), std::string::npos) << image.err;
  for (const char* option : {"--png", "--stats"}) {
    const Outcome outcome = runImporton(smallRender(folder / "o.exr", {"--passes", "1", option, "/dev/full"}));
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("free some space"), std::string::npos) << outcome.err;
    EXPECT_EQ(readExr(folder / "o.exr").width, 64);  // it was written before
    EXPECT_EQ(folder.entries(), 1);
  }
}

/// A folder on a disk of its own that holds `bytes`, or whose files may be no longer, which looks the same to a
/// program.
class ShortFiles {
 public:
  explicit ShortFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    ignored_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~ShortFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, ignored_);
  }
  ShortFiles(const ShortFiles&) = delete;
  ShortFiles& operator=(const ShortFiles&) = delete;

 private:
  rlimit before_{};
  void (*ignored_)(int) = SIG_DFL;
};

TEST(DiskFaults, AFileThatDoesNotFitLeavesTheOldOne) {
  const TemporaryFolder folder;
  test::writeFile(folder / "o.exr", "old");
  Outcome outcome;
  {
    const ShortFiles limit(4096);
    outcome = runImporton(smallRender(folder / "o.exr", {"--passes", "1"}));
  }
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write"), std::string::npos) << outcome.err;
  EXPECT_EQ(test::readFile(folder / "o.exr"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(DiskFaults, AFolderThatGoesAwayDuringTheRenderIsAnOutputError) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  const test::RunOptions removing{.hasTerminal = true, .onErr = [&](const std::string& err) {
                                    if (err.find("pass 1/") != std::string::npos)
                                      std::filesystem::remove_all(folder / "out");
                                    return 0;
                                  }};
  const Outcome outcome = runImporton(smallRender(folder / "out/o.exr", {"--passes", "20"}), removing);
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("create the folder first"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace importon
