#include "render/resume/checkpoint.h"

#include <gtest/gtest.h>

#include <span>

#include "base/error.h"
#include "support/temporary_folder.h"

namespace importon::checkpoint_test {
namespace {

using test::readFile;
using test::TemporaryFolder;
using test::writeFile;

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

Checkpoint sample() { return {0x123456789abcdef0u, 17, {{"film 0", bytesOf("some light")}, {"hits", {}}}}; }

/// The message of the SceneError that reading leads to.
std::string refusal(const std::filesystem::path& file) {
  try {
    (void)readCheckpoint(file);
  } catch (const SceneError& error) {
    return error.what();
  }
  ADD_FAILURE() << "read";
  return "";
}

TEST(Checkpoint, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  writeCheckpoint(folder / "c", sample());
  const Checkpoint read = readCheckpoint(folder / "c");
  EXPECT_EQ(read.fingerprint, 0x123456789abcdef0u);
  EXPECT_EQ(read.passes, 17);
  ASSERT_NE(read.find("film 0"), nullptr);
  EXPECT_EQ(read.find("film 0")->bytes, bytesOf("some light"));
  ASSERT_NE(read.find("hits"), nullptr);
  EXPECT_TRUE(read.find("hits")->bytes.empty());
  EXPECT_EQ(read.find("none"), nullptr);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Checkpoint, TornAnywhereIsRefused) {
  const TemporaryFolder folder;
  writeCheckpoint(folder / "c", sample());
  const std::string whole = readFile(folder / "c");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    writeFile(folder / "torn", whole.substr(0, length));
    const std::string message = refusal(folder / "torn");
    EXPECT_NE(message.find(length < 22 ? "no checkpoint" : "torn"), std::string::npos) << length << ": " << message;
  }
  writeFile(folder / "torn", whole + "x");
  EXPECT_NE(refusal(folder / "torn").find("torn"), std::string::npos);
}

TEST(Checkpoint, AnyChangedBitIsRefused) {
  const TemporaryFolder folder;
  writeCheckpoint(folder / "c", sample());
  const std::string whole = readFile(folder / "c");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    writeFile(folder / "changed", changed);
    EXPECT_THROW((void)readCheckpoint(folder / "changed"), SceneError) << i;
  }
}

TEST(Checkpoint, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "none").find("cannot read"), std::string::npos);
  EXPECT_THROW((void)readCheckpoint(folder.path()), SceneError);
  EXPECT_THROW(writeCheckpoint(folder / "no/c", sample()), OutputError);
}

}  // namespace
}  // namespace importon::checkpoint_test
