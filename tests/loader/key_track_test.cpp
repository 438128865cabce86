/// Interpolation against values worked by hand.
#include "scene/animation/key_track.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "scene/animation/slerp.h"

namespace importon::test {
namespace {

constexpr double kPi = glm::pi<double>();
using Values = std::vector<double>;

KeyTrack numbers(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
  return {interpolation, 1, false, std::move(times), std::move(values)};
}

TEST(KeyTrack, StepHoldsTheValueOfTheKeyBefore) {
  const KeyTrack track = numbers(Interpolation::step, {1, 2, 4}, {10, 20, 40});
  EXPECT_EQ(valueAt(track, 1), Values{10});
  EXPECT_EQ(valueAt(track, std::nextafter(2.0, 0.0)), Values{10});
  EXPECT_EQ(valueAt(track, 2), Values{20});
  EXPECT_EQ(valueAt(track, 3.999), Values{20});
}

TEST(KeyTrack, LinearGoesEvenlyFromKeyToKey) {
  const KeyTrack track = numbers(Interpolation::linear, {1, 2, 4}, {10, 20, 40});
  EXPECT_EQ(valueAt(track, 1.25), Values{12.5});
  EXPECT_EQ(valueAt(track, 3.5), Values{35});
  const KeyTrack vectors{Interpolation::linear, 3, false, {0, 2}, {1, 2, 3, 5, 0, 3}};
  EXPECT_EQ(valueAt(vectors, 0.5), (Values{2, 1.5, 3}));
}

TEST(KeyTrack, LinearStaysBetweenItsKeysHoweverItRounds) {
  const KeyTrack track = numbers(Interpolation::linear, {0, 1}, {0.1f, 1});
  for (double time = 0.999; time < 1; time = std::nextafter(time + 1e-7, 2)) EXPECT_LE(valueAt(track, time)[0], 1);
}

TEST(KeyTrack, BeforeTheFirstKeyAndAfterTheLastTheirValuesHold) {
  for (const Interpolation kind : {Interpolation::step, Interpolation::linear}) {
    const KeyTrack track = numbers(kind, {1, 2}, {10, 20});
    EXPECT_EQ(valueAt(track, 0), Values{10});
    EXPECT_EQ(valueAt(track, 2), Values{20});
    EXPECT_EQ(valueAt(track, 1e300), Values{20});
  }
  const KeyTrack spline = numbers(Interpolation::cubicSpline, {1, 2}, {5, 10, 6, 7, 20, 8});
  EXPECT_EQ(valueAt(spline, 0), Values{10});
  EXPECT_EQ(valueAt(spline, 3), Values{20});
  EXPECT_EQ(valueAt(numbers(Interpolation::linear, {1}, {10}), 5), Values{10});
}

TEST(KeyTrack, TheLastOfKeysAtOneTimeHolds) {
  const KeyTrack track = numbers(Interpolation::linear, {0, 1, 1, 2}, {0, 10, 30, 40});
  EXPECT_EQ(valueAt(track, 0.5), Values{5});
  EXPECT_EQ(valueAt(track, 1), Values{30});
  EXPECT_EQ(valueAt(track, 1.5), Values{35});
}

/// From 10 with slope 2 to 20 with slope -4, in 2 s: at the middle (10 + 20) / 2 + 2 (2 + 4) / 8.
TEST(KeyTrack, SplinesScaleTheirTangentsByTheInterval) {
  const KeyTrack track = numbers(Interpolation::cubicSpline, {1, 3}, {99, 10, 2, -4, 20, 99});
  EXPECT_EQ(valueAt(track, 1), Values{10});
  EXPECT_EQ(valueAt(track, 2), Values{16.5});
  // A quarter of the way: Hermite's 27/32, 9/64 · 2, 5/32 and -3/64 · 2.
  EXPECT_DOUBLE_EQ(valueAt(track, 1.5)[0], 27.0 / 32 * 10 + 9.0 / 32 * 2 + 5.0 / 32 * 20 - 3.0 / 32 * -4);
  constexpr double kStep = 1e-6;
  EXPECT_NEAR((valueAt(track, 1 + kStep)[0] - 10) / kStep, 2, 1e-4) << "the slope is the tangent";
}

KeyTrack rotations(Interpolation interpolation, std::vector<float> values) {
  return {interpolation, 4, true, {0, 1}, std::move(values)};
}

void expectRotation(const Values& found, const glm::dvec4& expected) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[static_cast<std::size_t>(c)], expected[c], 1e-7);
}

/// About z, by `angle`.
glm::dvec4 aboutZ(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

TEST(KeyTrack, RotationsGoAtConstantSpeed) {
  const auto half = static_cast<float>(std::sqrt(0.5));
  const KeyTrack track = rotations(Interpolation::linear, {0, 0, 0, 1, 0, 0, half, half});  // by 90 degrees
  for (const double share : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0})
    expectRotation(valueAt(track, share), aboutZ(share * kPi / 2));
}

TEST(KeyTrack, RotationsTakeTheShorterWay) {
  const auto half = static_cast<float>(std::sqrt(0.5));
  const KeyTrack track = rotations(Interpolation::linear, {0, 0, 0, 1, 0, 0, -half, -half});  // 90 or -270 degrees
  expectRotation(valueAt(track, 0.5), aboutZ(kPi / 4));
}

TEST(KeyTrack, RotationsNeedNoUnitLength) {
  const KeyTrack track = rotations(Interpolation::linear, {0, 0, 0, 7, 0, 0, 3, 3});
  expectRotation(valueAt(track, 0.5), aboutZ(kPi / 4));
  expectRotation(valueAt(track, 0), aboutZ(0));
  const KeyTrack none = rotations(Interpolation::linear, {0, 0, 0, 0, 0, 0, 0, 0});
  expectRotation(valueAt(none, 0.5), aboutZ(0));
}

TEST(KeyTrack, SplinesOfRotationsAreOfUnitLength) {
  std::vector<float> values(24, 0.0f);
  values[7] = 1;       // of key 0: none
  values[12 + 6] = 1;  // of key 1: half a turn about z
  const KeyTrack track = rotations(Interpolation::cubicSpline, values);
  expectRotation(valueAt(track, 0.5), aboutZ(kPi / 2));
}

TEST(Slerp, NearRotationsDoNotLoseTheirWay) {
  for (const double angle : {1e-3, 1e-8, 1e-15, 1e-150, 0.0}) {
    const glm::dvec4 middle = slerp(aboutZ(0), aboutZ(angle), 0.5);
    EXPECT_NEAR(middle.z, std::sin(angle / 4), angle * 1e-15);
    EXPECT_NEAR(middle.w, std::cos(angle / 4), 1e-15);
  }
  const glm::dvec4 turned = slerp(aboutZ(0), aboutZ(kPi), 1.0 / 3);  // as far as it can be
  EXPECT_NEAR(turned.z, std::sin(kPi / 6), 1e-15);
}

TEST(Slerp, ItsElementaryFunctionsAreThose) {
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    EXPECT_NEAR(portableSine(x * kPi / 2), std::sin(x * kPi / 2), 2.3e-16) << x;
    EXPECT_NEAR(portableArctangent(x), std::atan(x), 1e-15 * x) << x;  // roundings of four halvings
  }
}

/// Bits as they came out once, to be the same on every machine.
TEST(Slerp, HasTheSameBitsEverywhere) {
  const glm::dvec4 found = slerp(glm::dvec4(0, 0, 0, 1), glm::dvec4(0.5, 0.5, 0.5, 0.5), 0.3);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(found.x), 4595595955612694022u);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(found.w), 4606741575090066688u);
}

}  // namespace
}  // namespace importon::test
