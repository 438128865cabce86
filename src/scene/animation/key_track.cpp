#include "scene/animation/key_track.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "scene/animation/slerp.h"

namespace importon {
namespace {

using Values = std::vector<double>;

/// Which of the numbers of a spline's key.
enum Part : std::size_t { inTangent = 0, value = 1, outTangent = 2 };

Values partOfKey(const KeyTrack& track, std::size_t key, Part part) {
  const bool isSpline = track.interpolation == Interpolation::cubicSpline;
  const std::size_t first = (isSpline ? 3 * key + part : key) * track.width;
  const auto begin = track.values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(track.width)};
}

glm::dvec4 unitRotation(const Values& values) {
  const glm::dvec4 rotation(values[0], values[1], values[2], values[3]);
  const double length = glm::length(rotation);
  return length > 0 && std::isfinite(length) ? rotation / length : glm::dvec4(0, 0, 0, 1);
}

Values valuesOf(const glm::dvec4& rotation) { return {rotation.x, rotation.y, rotation.z, rotation.w}; }

Values linear(const KeyTrack& track, std::size_t key, double share) {
  const Values from = partOfKey(track, key, value), to = partOfKey(track, key + 1, value);
  if (track.isRotation) return valuesOf(slerp(unitRotation(from), unitRotation(to), share));
  Values between(track.width);
  for (std::size_t i = 0; i < track.width; ++i) {  // rounding leads out of no range that both ends are in
    const auto [least, most] = std::minmax(from[i], to[i]);
    between[i] = std::clamp(from[i] + (to[i] - from[i]) * share, least, most);
  }
  return between;
}

/// glTF 2.0, section C.5.
Values spline(const KeyTrack& track, std::size_t key, double share, double interval) {
  const Values from = partOfKey(track, key, value), leaving = partOfKey(track, key, outTangent),
               to = partOfKey(track, key + 1, value), arriving = partOfKey(track, key + 1, inTangent);
  const double t = share, t2 = t * t, t3 = t2 * t;
  Values between(track.width);
  for (std::size_t i = 0; i < track.width; ++i) {
    between[i] = (2 * t3 - 3 * t2 + 1) * from[i] + interval * (t3 - 2 * t2 + t) * leaving[i] +
                 (-2 * t3 + 3 * t2) * to[i] + interval * (t3 - t2) * arriving[i];
  }
  return between;
}

Values between(const KeyTrack& track, std::size_t key, double seconds) {
  const double from = track.times[key], interval = track.times[key + 1] - from;
  const double share = (seconds - from) / interval;
  switch (track.interpolation) {
    case Interpolation::step:
      break;
    case Interpolation::linear:
      return linear(track, key, share);
    case Interpolation::cubicSpline:
      return spline(track, key, share, interval);
  }
  return partOfKey(track, key, value);
}

}  // namespace

std::vector<double> valueAt(const KeyTrack& track, double seconds) {
  const auto next = std::ranges::upper_bound(track.times, seconds, {}, [](float time) { return double{time}; });
  const bool isBefore = next == track.times.begin(), isAfter = next == track.times.end();
  const auto key = static_cast<std::size_t>(next - track.times.begin()) - (isBefore ? 0 : 1);
  const Values found = isBefore || isAfter ? partOfKey(track, key, value) : between(track, key, seconds);
  return track.isRotation ? valuesOf(unitRotation(found)) : found;
}

}  // namespace importon
