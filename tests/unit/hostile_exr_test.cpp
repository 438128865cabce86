// OpenEXR files that once broke the reader, or are made to.
#include <ImfHeader.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon::hostile_exr_test {
namespace {

std::string errorOf(const std::filesystem::path& file) {
  try {
    (void)readExr(file);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(HostileExr, WhatTheFuzzerFoundIsRefused) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(IMPORTON_SOURCES) / "tests/data/hostile")) {
    if (entry.path().extension() != ".exr") continue;
    ++files;
    EXPECT_NE(errorOf(entry.path()), "") << entry.path();
  }
  EXPECT_GT(files, 0);
}

/// A row of 2^22 pixels in blocks of 256 rows: memory for 2^30 values, for a picture of 2^22.
TEST(HostileExr, ALongRowDoesNotTakeTheMemoryOfManyRows) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "long.exr";
  writeExr(file, Image{2, 1, {{"R", {1, 2}}}, {}});
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::int32_t last = (1 << 22) - 1;
  std::memcpy(&bytes[bytes.find("box2i", bytes.find("dataWindow")) + 6 + 4 + 8], &last, sizeof last);
  constexpr char kDwab = 9;
  bytes[bytes.find("compression", bytes.find("compression") + 11) + 12 + 4] = kDwab;  // its name, its type, its size
  std::ofstream(file, std::ios::binary) << bytes << std::string(16384, '\1');
  EXPECT_NE(errorOf(file).find("rows are too long for the image"), std::string::npos) << errorOf(file);
}

TEST(HostileExr, ASmallFileDoesNotTakeTheMemoryOfAHugeImage) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "huge.exr";
  writeExr(file, Image{2, 2, {{"R", {1, 2, 3, 4}}}, {}});
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t window = bytes.find("box2i", bytes.find("dataWindow")) + 6 + 4;  // its name, its size
  for (const std::size_t corner : {window + 8, window + 12}) {
    const std::int32_t last = 19999;
    std::memcpy(&bytes[corner], &last, sizeof last);
  }
  std::ofstream(file, std::ios::binary) << bytes << std::string(16384, '\1');  // a table of places for its rows
  EXPECT_NE(errorOf(file).find("cannot hold 20000 x 20000 pixels"), std::string::npos) << errorOf(file);
}

}  // namespace
}  // namespace importon::hostile_exr_test
