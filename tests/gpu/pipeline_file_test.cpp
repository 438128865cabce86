// Pipelines kept from one run to the next: what was written is read, what is damaged is not.
#include "gpu/pipeline_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "support/gpu_test.h"
#include "support/temporary_folder.h"

namespace importon::gpu {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytesOf(std::size_t count, int first = 1) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(static_cast<std::size_t>(first) + i);
  return bytes;
}

PipelineKey keyOf(std::uint64_t kernels) { return {{1, 2, 3}, 4, 5, 6, kernels}; }

class PipelineFileTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  PipelineFile file_{folder_ / "cache", keyOf(7)};
};

TEST_F(PipelineFileTest, IsReadAsItWasWritten) {
  EXPECT_TRUE(file_.read().empty());
  for (const std::size_t count : {1000u, 10u}) {
    EXPECT_TRUE(file_.write(bytesOf(count)));
    EXPECT_EQ(PipelineFile(folder_ / "cache", keyOf(7)).read(), bytesOf(count));
  }
}

TEST_F(PipelineFileTest, IsOfOneDriverDeviceAndBuildOnly) {
  ASSERT_TRUE(file_.write(bytesOf(100)));
  PipelineKey others[] = {keyOf(7), keyOf(7), keyOf(7), keyOf(7), keyOf(8)};
  others[0].cacheId[15] = 1;
  others[1].vendor = others[2].device = others[3].driver = 9;
  for (const PipelineKey& other : others) {
    const PipelineFile file(folder_ / "cache", other);
    EXPECT_TRUE(file.read().empty());
    std::filesystem::copy_file(file_.path(), file.path());  // under a name that is not its own
    EXPECT_TRUE(file.read().empty());
  }
}

TEST_F(PipelineFileTest, ThatIsTruncatedOrDamagedIsNotReadAndWrittenAnew) {
  ASSERT_TRUE(file_.write(bytesOf(100)));
  const std::string whole = test::readFile(file_.path());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::writeFile(file_.path(), whole.substr(0, size));
    EXPECT_TRUE(file_.read().empty()) << size << " bytes";
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    test::writeFile(file_.path(), damaged);
    EXPECT_TRUE(file_.read().empty()) << "byte " << at;
  }
  EXPECT_TRUE(file_.write(bytesOf(100)));
  EXPECT_EQ(file_.read(), bytesOf(100));
}

TEST_F(PipelineFileTest, IsNotKeptWhereItCannotBe) {
  EXPECT_FALSE(PipelineFile({}, keyOf(7)).write(bytesOf(100)));
  EXPECT_TRUE(PipelineFile({}, keyOf(7)).read().empty());
  test::writeFile(folder_ / "file", "");
  const PipelineFile inFile(folder_ / "file", keyOf(7));
  EXPECT_FALSE(inFile.write(bytesOf(100)));
  EXPECT_TRUE(inFile.read().empty());
  EXPECT_FALSE(file_.write(Bytes(PipelineFile::kMostBytes + 1)));
  std::filesystem::create_directories(file_.path());  // a folder in its place
  EXPECT_FALSE(file_.write(bytesOf(100)));
  EXPECT_TRUE(file_.read().empty());
  if (geteuid() == 0) return;  // may write anywhere
  std::filesystem::create_directory(folder_ / "closed");
  std::filesystem::permissions(folder_ / "closed", std::filesystem::perms::owner_read);
  EXPECT_FALSE(PipelineFile(folder_ / "closed", keyOf(7)).write(bytesOf(100)));
}

TEST_F(PipelineFileTest, OfManyTheOldestGo) {
  for (std::uint64_t kernels = 0; kernels < 2 * PipelineFile::kMostFiles; ++kernels)
    EXPECT_TRUE(PipelineFile(folder_.path(), keyOf(kernels)).write(bytesOf(10)));
  EXPECT_EQ(folder_.entries(), static_cast<std::ptrdiff_t>(PipelineFile::kMostFiles));
  EXPECT_FALSE(PipelineFile(folder_.path(), keyOf(2 * PipelineFile::kMostFiles - 1)).read().empty());
}

TEST_F(PipelineFileTest, IsWholeWhileOthersReplaceIt) {
  ASSERT_TRUE(file_.write(bytesOf(5000, 0)));
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([this, i] {
      for (int n = 0; n < 50; ++n) EXPECT_TRUE(file_.write(bytesOf(5000, i)));
    });
  for (int n = 0; n < 200; ++n) EXPECT_EQ(file_.read().size(), 5000u);
  for (std::thread& writer : writers) writer.join();
}

TEST(UserCacheFolder, IsThatOfTheEnvironmentIfItIsAbsolute) {
  const char* oldHome = std::getenv("HOME");
  const std::string home = oldHome == nullptr ? "" : oldHome;
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(userCacheFolder(), "/somewhere/importon");
  setenv("XDG_CACHE_HOME", "relative", 1);
  setenv("HOME", "/home/x", 1);
  EXPECT_EQ(userCacheFolder(), "/home/x/.cache/importon");
  unsetenv("XDG_CACHE_HOME");
  unsetenv("HOME");
  EXPECT_EQ(userCacheFolder(), "");
  if (oldHome != nullptr) setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace importon::gpu
