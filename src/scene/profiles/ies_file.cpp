#include "scene/profiles/ies_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string_view>

#include "base/error.h"

namespace importon {
namespace {

constexpr double kMostCandela = 1e18;
constexpr const char* kRemedy = "use an IES LM-63 file of photometry of type B or C";

/// The numbers of a file, one after another.
class IesReader {
 public:
  IesReader(std::span<const unsigned char> bytes, const std::string& where)
      : left_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), where_(where) {}

  IesProfile read() {
    skipToTilt();
    (void)number();  // lamps
    (void)number();  // lumens of a lamp
    const double multiplier = number();
    const std::size_t verticals = count(), horizontals = count();
    const double type = number();
    if (type != 1 && type != 2) fail(fmt::format("the IES file has photometry of type number {}", type));
    constexpr int kUnitsAndSizes = 4;
    for (int i = 0; i < kUnitsAndSizes; ++i) (void)number();
    const double ballast = number();
    (void)number();                                                               // for future use
    (void)number();                                                               // W
    if (verticals * horizontals > left_.size()) fail("the IES file is cut off");  // a character for each, at least
    std::vector<double> vertical = angles(verticals), horizontal = angles(horizontals), candela;
    for (std::size_t i = 0; i < verticals * horizontals; ++i)
      candela.push_back(std::clamp(number() * multiplier * ballast, 0.0, kMostCandela));
    return {type == 1 ? Photometry::typeC : Photometry::typeB, std::move(vertical), std::move(horizontal),
            std::move(candela)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw SceneError(what, where_, kRemedy); }

  std::string_view line() {
    const std::size_t end = std::min(left_.find('\n'), left_.size());
    const std::string_view text = left_.substr(0, end);
    left_.remove_prefix(std::min(end + 1, left_.size()));
    return text;
  }

  /// What comes before is text.
  void skipToTilt() {
    while (!left_.empty()) {
      std::string_view text = line();
      text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
      if (!text.starts_with("TILT=")) continue;
      if (!text.starts_with("TILT=INCLUDE")) return;
      (void)number();  // the lamp's geometry
      const std::size_t pairs = count();
      for (std::size_t i = 0; i < 2 * pairs; ++i) (void)number();
      return;
    }
    fail("this is no IES file: it has no line TILT=");
  }

  double number() {
    constexpr std::string_view kBetween = " \t\r\n,";
    left_.remove_prefix(std::min(left_.find_first_not_of(kBetween), left_.size()));
    if (left_.starts_with('+')) left_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    if (left_.empty()) fail("the IES file is cut off");
    if (error != std::errc() || !std::isfinite(value)) fail("the IES file has something else for a number");
    left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    return value;
  }

  std::size_t count() {
    constexpr double kMost = 1e5;
    const double value = number();
    if (value < 1 || value > kMost || value != std::floor(value))
      fail(fmt::format("the IES file has {} for a count", value));
    return static_cast<std::size_t>(value);
  }

  std::vector<double> angles(std::size_t size) {
    std::vector<double> all;
    for (std::size_t i = 0; i < size; ++i) all.push_back(number());
    if (!std::ranges::is_sorted(all)) fail("the angles of the IES file are not in order");
    return all;
  }

  std::string_view left_;
  const std::string& where_;
};

/// Where `angle` lies among ascending angles: the index of the one before it, and how far beyond. Below 0: outside.
struct AngleWeight {
  std::size_t index = 0;
  double share = -1;
};
AngleWeight placeAmong(const std::vector<double>& angles, double angle) {
  constexpr double kRounding = 1e-9;
  if (angle < angles.front() - kRounding || angle > angles.back() + kRounding) return {};
  const auto above = std::ranges::upper_bound(angles, angle);
  const auto next = static_cast<std::size_t>(above - angles.begin());
  if (next == 0) return {0, 0};
  if (next == angles.size()) return {next - 1, 0};
  return {next - 1, (angle - angles[next - 1]) / (angles[next] - angles[next - 1])};
}

}  // namespace

/// The angle of those that the file has which stands for this one.
double IesProfile::horizontalOf(double angle) const {
  constexpr double kRight = 90, kStraight = 180, kTurn = 360;
  const double first = horizontal_.front(), last = horizontal_.back();
  if (photometry_ == Photometry::typeB) return first >= 0 ? std::abs(angle) : angle;
  if (isAxial()) return first;
  if (first >= kRight && last <= kTurn - kRight) {  // LM-63-95: alike on both sides of the plane of 90 degrees
    return angle < kRight ? kStraight - angle : angle > kTurn - kRight ? kTurn + kStraight - angle : angle;
  }
  if (last > kStraight) return angle;
  const double folded = angle > kStraight ? kTurn - angle : angle;
  return last <= kRight && folded > kRight ? kStraight - folded : folded;
}

double IesProfile::intensity(const glm::dvec3& direction) const {
  const glm::dvec3 d = glm::clamp(direction, -1.0, 1.0);
  double vertical, horizontal;
  if (photometry_ == Photometry::typeC) {
    vertical = glm::degrees(std::acos(-d.z));
    horizontal = glm::degrees(std::atan2(d.y, d.x));
    if (horizontal < 0) horizontal += 360;
  } else {  // the planes turn around x, clockwise
    vertical = glm::degrees(std::asin(d.x));
    if (vertical_.front() >= 0) vertical = std::abs(vertical);
    horizontal = d.y == 0 && d.z == 0 ? 0 : glm::degrees(std::atan2(-d.y, -d.z));
  }
  const AngleWeight v = placeAmong(vertical_, vertical), h = placeAmong(horizontal_, horizontalOf(horizontal));
  if (v.share < 0 || h.share < 0) return 0;
  const auto along = [&](std::size_t plane) {
    const std::size_t at = plane * vertical_.size() + v.index;
    return v.share > 0 ? candela_[at] + v.share * (candela_[at + 1] - candela_[at]) : candela_[at];
  };
  const double here = along(h.index);
  return h.share > 0 ? here + h.share * (along(h.index + 1) - here) : here;
}

IesProfile parseIes(std::span<const unsigned char> bytes, const std::string& where) {
  return IesReader(bytes, where).read();
}

}  // namespace importon
