#include "base/hash.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <string>
#include <vector>

namespace importon {
namespace {

std::uint64_t hashOf(std::initializer_list<std::string_view> pieces) {
  ContentHash hash;
  for (const std::string_view piece : pieces) hash.add(piece);
  return hash.value();
}

TEST(ContentHash, IsTheSameForTheSameContents) { EXPECT_EQ(hashOf({"one", "two"}), hashOf({"one", "two"})); }

TEST(ContentHash, TellsPiecesApart) {
  EXPECT_NE(hashOf({"ab", "c"}), hashOf({"a", "bc"}));
  EXPECT_NE(hashOf({"a", "b"}), hashOf({"b", "a"}));
  EXPECT_NE(hashOf({""}), hashOf({}));
}

TEST(ContentHash, TellsLengthsOfZerosApart) {
  std::set<std::uint64_t> values;
  for (std::size_t length = 0; length < 100; ++length) values.insert(hashOf({std::string(length, '\0')}));
  EXPECT_EQ(values.size(), 100u);
}

// Each output bit should flip with probability 1/2: over 200 * 64 flips the mean count of 32 has a standard
// deviation of 4/sqrt(12800) = 0.035; 0.25 is seven of them.
TEST(ContentHash, SpreadsOneBitOverTheWholeValue) {
  std::vector<std::byte> data(25, std::byte{0x5a});
  const auto hash = [&] {
    ContentHash contents;
    contents.add(data);
    return contents.value();
  };
  const std::uint64_t before = hash();
  double flips = 0;
  for (std::size_t bit = 0; bit < 200; ++bit) {
    data[bit / 8] ^= std::byte{1} << (bit % 8);
    const int count = std::popcount(before ^ hash());
    EXPECT_GT(count, 8);
    flips += count;
    data[bit / 8] ^= std::byte{1} << (bit % 8);
  }
  EXPECT_NEAR(flips / 200, 32, 2);  // 200 draws of standard deviation 4: seven of 0.28
}

}  // namespace
}  // namespace importon
