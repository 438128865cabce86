#include "base/large_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>

namespace importon::test {
namespace {

TEST(LargeVector, KeepsWhatIsWrittenAcrossSmallAndHugeSizes) {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{3}, std::size_t{524287}, std::size_t{524288}, std::size_t{700000}}) {
    LargeVector<std::uint32_t> values(count);
    std::iota(values.begin(), values.end(), 7u);
    values.push_back(1);
    LargeVector<std::uint32_t> copy = values;
    ASSERT_EQ(copy.size(), count + 1);
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(copy[i], i + 7);
    EXPECT_EQ(copy.back(), 1u);
  }
}

TEST(LargeVector, FillsWithAValueThatIsGiven) {
  for (const float value : LargeVector<float>(600000, 2.5f)) ASSERT_EQ(value, 2.5f);
}

TEST(LargeVector, HugeArraysStartAtHugePages) {
  const LargeVector<std::uint32_t> values(1u << 20);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(values.data()) % (2u << 20), 0u);
}

TEST(LargeVector, ConstructsTypesThatNeedIt) {
  const LargeVector<std::string> names(3);
  EXPECT_EQ(names, LargeVector<std::string>({"", "", ""}));
}

}  // namespace
}  // namespace importon::test
