#include "app/progress.h"

#include <gtest/gtest.h>

#include <limits>

namespace importon {
namespace {

TEST(ProgressLine, TellsAllThatIsKnown) {
  EXPECT_EQ(progressLine({3, 64, 12, 1.234e6, 45.67e6, 40}),
            "pass 3/64  12 s  1.23 Mphotons/s  45.7 Mrays/s  40 s left");
}

TEST(ProgressLine, TellsTheErrorAndItsTarget) {
  EXPECT_EQ(progressLine({3, 64, 12, 0, 0, 40, 0.0621, 0.05}), "pass 3/64  12 s  error 6.2 % of 5 %  40 s left");
  EXPECT_EQ(progressLine({3, 64, 12, 0, 0, 40, 0.5, -1}), "pass 3/64  12 s  error 50 %  40 s left");
  EXPECT_EQ(progressLine({3, 64, 12, 0, 0, 40, -1, 0.05}), "pass 3/64  12 s  40 s left");
}

TEST(ProgressLine, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(progressLine({1, 0, 0.5, 0, 0, -1}), "pass 1  1 s");
  EXPECT_EQ(progressLine({1, 0, 0.5, 0, 0, std::numeric_limits<double>::infinity()}), "pass 1  1 s");
}

TEST(ProgressLine, KeepsThreeDigitsOfARate) {
  const auto rate = [](double value) {
    const std::string line = progressLine({1, 1, 0, 0, value, -1});
    return line.substr(line.find("0 s  ") + 5);
  };
  EXPECT_EQ(rate(999.4), "999 rays/s");
  EXPECT_EQ(rate(999.6), "1.00 krays/s");
  EXPECT_EQ(rate(9.996e3), "10.0 krays/s");
  EXPECT_EQ(rate(99.96e6), "100 Mrays/s");
  EXPECT_EQ(rate(2.5e9), "2.50 Grays/s");
}

TEST(ProgressLine, TellsLongTimesInMinutesAndHours) {
  EXPECT_EQ(progressLine({1, 2, 185, 0, 0, 7440}), "pass 1/2  3 min 05 s  2 h 04 min left");
  EXPECT_EQ(progressLine({1, 2, 59.5, 0, 0, 3599.5}), "pass 1/2  1 min 00 s  1 h 00 min left");
}

}  // namespace
}  // namespace importon
