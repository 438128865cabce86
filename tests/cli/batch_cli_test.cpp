// What a batch refuses before it renders anything: exit status 1 or 4, one line.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "cli/program.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;
using test::writeFile;

/// One line with all `parts`, and no file that was not there.
void expectRefusal(const Outcome& outcome, int status, const std::vector<std::string>& parts) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.find("importon: error: "), 0u) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  for (const std::string& part : parts) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

class CliBatch : public testing::Test {
 protected:
  /// Renders a list of this text into the folder `out`.
  [[nodiscard]] Outcome runList(const std::string& text, const std::vector<std::string>& more = {}) const {
    writeFile(folder_ / "jobs.list", text);
    std::vector<std::string> arguments{"--list", folder_ / "jobs.list", "-o", folder_ / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runImporton(arguments);
  }
  void expectNothingMade() const { EXPECT_FALSE(std::filesystem::exists(folder_ / "out")); }

  TemporaryFolder folder_;
};

TEST_F(CliBatch, NeedsAFolderForSeveralPictures) {
  expectRefusal(runImporton({"a.glb", "b.glb", "-o", folder_ / "o.exr"}), 1, {"--output names a folder", "o.exr"});
  expectRefusal(runImporton({"a.glb", "--camera", "all", "-o", folder_ / "o.exr"}), 1, {"--output names a folder"});
  expectRefusal(runImporton({"a.glb", "b.glb", "-o", folder_ / "out", "--png", "o.png"}), 1, {"--png names a folder"});
  expectRefusal(runImporton({"a.glb", "b.glb"}), 1, {"--output is required"});
  EXPECT_EQ(folder_.entries(), 0);
}

TEST_F(CliBatch, RefusesOutputsThatAreAlike) {
  expectRefusal(runImporton({"x/a.glb", "y/a.gltf", "-o", folder_ / "out"}), 1, {"the same name", "out/a.exr"});
  expectRefusal(runList("a.glb -o one.exr\nb.glb -o ../out/./one.exr\n"), 1, {"the same name", "one.exr"});
  expectRefusal(runList("a.glb --png p.png\nb.glb --png p.png\n"), 1, {"the same name", "p.png"});
  expectRefusal(runList("a.glb --camera all\na.b.glb\n"), 1, {"the same name", "a.b.exr"});
  expectRefusal(runList("a.glb\nb.glb -o s.json\n", {"--stats", folder_ / "out/s.json"}), 1, {"the same name"});
  expectRefusal(runList("a.glb --reference jobs/r.exr\nb.glb -o ../jobs/r.exr\n"), 1, {"written over", "r.exr"});
  expectNothingMade();
}

TEST_F(CliBatch, RefusesAFileOfOnePictureForAll) {
  expectRefusal(runImporton({"a.glb", "b.glb", "-o", folder_ / "out", "--checkpoint", "c"}), 1, {"--checkpoint"});
  expectRefusal(runList("a.glb\n", {"--resume", "c"}), 1, {"--resume", "list"});
}

TEST_F(CliBatch, RefusesABadLineByItsNumber) {
  expectRefusal(runList("# two\n\na.glb --widht 3\n"), 1, {"--widht", "jobs.list:3"});
  expectRefusal(runList("a.glb\nb.glb --width 0\n"), 1, {"--width", "jobs.list:2"});
  expectRefusal(runList("a.glb b.glb\n"), 1, {"one scene", "jobs.list:1"});
  expectRefusal(runList("--width 3\n"), 1, {"SCENE is required", "jobs.list:1"});
  expectRefusal(runList("a.glb --list jobs.list\n"), 1, {"--list", "jobs.list:1"});
  expectRefusal(runList("a.glb --help\n"), 1, {"--help", "jobs.list:1"});
  expectRefusal(runList("'a.glb\n"), 1, {"quote", "jobs.list:1"});
  expectRefusal(runList(std::string("a.glb\n\0\n", 8)), 1, {"control characters", "jobs.list:2"});
  expectRefusal(runList("a.glb --transparent\n", {"--background", "1,1,1"}), 1, {"--transparent", "jobs.list:1"});
  expectRefusal(runList("a.glb --light studio\n", {"--environment", "e.exr"}), 1, {"--environment", "jobs.list:1"});
  writeFile(folder_ / "jobs.list", "a.glb\n");
  expectRefusal(runImporton({"--list", folder_ / "jobs.list"}), 1, {"--output is required", "jobs.list:1"});
  expectNothingMade();
}

TEST_F(CliBatch, RefusesAListThatIsNone) {
  expectRefusal(runList(""), 1, {"names no scene", "jobs.list"});
  expectRefusal(runList("# a.glb\n \t\r\n"), 1, {"names no scene"});
  expectRefusal(runList(std::string((4u << 20) + 1, ' ')), 1, {"larger than 4 MiB"});
  std::string many;
  for (int i = 0; i <= 10'000; ++i) many += "a\n";
  expectRefusal(runList(many), 1, {"more than 10,000 jobs"});
  expectRefusal(runImporton({"--list", folder_ / "none", "-o", folder_ / "out"}), 1, {"cannot be read", "none"});
  expectRefusal(runImporton({"--list", folder_.path(), "-o", folder_ / "out"}), 1, {"cannot be read"});
  expectNothingMade();
}

TEST_F(CliBatch, RefusesAFolderThatCannotBeMade) {
  writeFile(folder_ / "file", "");
  expectRefusal(runImporton({kCornellBox, "b.glb", "-o", folder_ / "file"}), 4, {"folder", "file"});
  expectRefusal(runImporton({kCornellBox, "b.glb", "-o", folder_ / "out", "--stats", folder_ / "no/s.json"}), 4,
                {"create the folder", "s.json"});
  if (geteuid() == 0) return;  // may write anywhere
  std::filesystem::create_directory(folder_ / "shut");
  std::filesystem::permissions(folder_ / "shut", std::filesystem::perms::owner_read);
  expectRefusal(runImporton({kCornellBox, "b.glb", "-o", folder_ / "shut"}), 4, {"may write", "shut"});
}

TEST_F(CliBatch, GoesOnWhereNoSceneCanBeRead) {
  writeFile(folder_ / "bad.gltf", "{ \"asset\": ");
  const Outcome outcome =
      runImporton({folder_ / "none.gltf", folder_ / "bad.gltf", "-o", folder_ / "out", "--stats", folder_ / "s.json"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("importon: error: the file does not exist"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("bad.gltf"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("0 of 2 pictures"), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
}

}  // namespace
}  // namespace importon
