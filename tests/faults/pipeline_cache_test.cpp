// What a driver has compiled is kept for the next run, in the user's cache folder. The drivers at hand keep nothing, so
// a layer makes up what one has to keep: fault_layer.cpp.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/program.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;

class PipelineCache : public testing::Test {
 protected:
  [[nodiscard]] Outcome render(const std::vector<std::string>& options = {}, const char* pipelines = "pipelines 1000") {
    std::vector<std::string> words{kCornellBox, "-o",  folder_ / "o.exr", "--width", "16",       "--height", "16",
                                   "--photons", "100", "--importons",     "100",     "--passes", "1",        "-q"};
    words.insert(words.end(), options.begin(), options.end());
    return runImporton(words, {.environment = {{"VK_INSTANCE_LAYERS", "VK_LAYER_IMPORTON_fault"},
                                               {"VK_LAYER_PATH", IMPORTON_FAULT_LAYER},
                                               {"IMPORTON_TEST_FAULT", pipelines},
                                               {"MESA_SHADER_CACHE_DIR", driversFolder()},
                                               {"XDG_CACHE_HOME", folder_ / "cache"}}});
  }
  void expectRead(const Outcome& outcome, bool isRead) {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, isRead ? "1032 bytes of pipelines\n" : "");
  }
  /// Of the driver's own cache: that of other tests, which has what they compiled.
  [[nodiscard]] std::string driversFolder() const {
    const char* home = std::getenv("HOME");
    return home == nullptr ? folder_ / "driver" : std::filesystem::path(home) / ".cache";
  }
  [[nodiscard]] std::filesystem::path kept() const {
    return std::filesystem::directory_iterator(folder_ / "cache" / "importon")->path();
  }

  TemporaryFolder folder_;
};

TEST_F(PipelineCache, IsReadByTheNextRunIfItIsWhole) {
  expectRead(render({"--no-cache"}), false);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache" / "importon"));
  expectRead(render(), false);
  expectRead(render(), true);
  expectRead(render({"--no-cache"}), false);
  std::filesystem::resize_file(kept(), 500);
  expectRead(render(), false);
  expectRead(render(), true);
}

TEST_F(PipelineCache, OfAFolderThatCannotBeWrittenIsLeft) {
  std::filesystem::create_directory(folder_ / "cache");
  test::writeFile(folder_ / "cache" / "importon", "a file");
  expectRead(render(), false);
}

TEST_F(PipelineCache, OfADriverThatKeepsNothingIsNotWritten) {
  expectRead(render({}, "none 0"), false);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache" / "importon"));
}

}  // namespace
}  // namespace importon
