#include "io/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/error.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon::output_file_test {
namespace {

namespace fs = std::filesystem;
using test::readFile;
using test::TemporaryFolder;
using test::writeFile;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

TEST(OutputFile, AppearsWholeOnCommit) {
  const TemporaryFolder folder;
  OutputFile output(folder / "out");
  output.write(bytesOf("hello"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  output.commit();
  EXPECT_EQ(readFile(folder / "out"), "hello");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  { OutputFile(folder / "out").write(bytesOf("hello")); }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(OutputFile, KeepsTheOlderFileWithoutCommit) {
  const TemporaryFolder folder;
  writeFile(folder / "out", "old");
  { OutputFile(folder / "out").write(bytesOf("new")); }
  EXPECT_EQ(readFile(folder / "out"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, OverwritesWhereItSeeks) {
  const TemporaryFolder folder;
  OutputFile output(folder / "out");
  output.write(bytesOf("hello world"));
  output.seek(6);
  output.write(bytesOf("there"));
  EXPECT_EQ(output.position(), 11u);
  output.commit();
  EXPECT_EQ(readFile(folder / "out"), "hello there");
}

TEST(OutputFile, WritesMoreThanItsBuffer) {
  const TemporaryFolder folder;
  const std::string megabytes(std::size_t{5} << 20, 'x');
  writeTextFile(folder / "out", megabytes);
  EXPECT_EQ(readFile(folder / "out"), megabytes);
}

TEST(OutputFile, FollowsLinksEvenToNothing) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub/real", folder / "link");
  writeTextFile(folder / "link", "text");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(readFile(folder / "sub/real"), "text");
}

TEST(OutputFile, WritesToADeviceWithoutReplacingIt) {
  writeTextFile("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, ReportsAFullDisk) {
  try {
    writeTextFile("/dev/full", "text");
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_STREQ(error.what(),
                 "cannot write: No space left on device (/dev/full): free some space, or choose another folder");
  }
}

TEST(OutputFile, ReportsAMissingFolder) {
  const TemporaryFolder folder;
  EXPECT_THROW(OutputFile(folder / "none/out"), OutputError);
  EXPECT_THROW(OutputFile(folder.path()), OutputError);
  EXPECT_THROW(OutputFile(""), OutputError);
}

TEST(OutputFile, ReportsAFileInPlaceOfAFolder) {
  const TemporaryFolder folder;
  writeFile(folder / "file", "");
  EXPECT_THROW(OutputFile(folder / "file/out"), OutputError);
}

TEST(CheckWritable, LeavesNoTrace) {
  const TemporaryFolder folder;
  checkWritable(folder / "out");
  EXPECT_EQ(folder.entries(), 0);
  writeFile(folder / "old", "kept");
  checkWritable(folder / "old");
  EXPECT_EQ(readFile(folder / "old"), "kept");
}

TEST(CheckWritable, FindsNamesThatAreTooLong) {
  const TemporaryFolder folder;
  EXPECT_THROW(checkWritable(folder / std::string(300, 'n')), OutputError);
  EXPECT_NO_THROW(checkWritable(folder / std::string(255, 'n')));
}

/// The superuser may write anywhere; while this lives, the process is nobody in particular.
class OrdinaryUser {
 public:
  OrdinaryUser() : before_(geteuid()) {
    constexpr uid_t kNobody = 65534;
    if (before_ == 0 && seteuid(kNobody) != 0) throw std::runtime_error("cannot become another user");
  }
  ~OrdinaryUser() {
    if (seteuid(before_) != 0) std::abort();
  }

 private:
  uid_t before_;
};

TEST(CheckWritable, FindsFoldersAndFilesThatForbidWriting) {
  const TemporaryFolder folder;
  writeFile(folder / "old.exr", "kept");
  fs::permissions(folder / "old.exr", fs::perms::owner_read);
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  {
    const OrdinaryUser user;
    EXPECT_THROW(checkWritable(folder / "new.exr"), OutputError);
    EXPECT_THROW(checkWritable(folder / "old.exr"), OutputError);
  }
  fs::permissions(folder.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace importon::output_file_test
