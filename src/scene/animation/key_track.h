/// Values that are given at some times, and what is between them.
#pragma once
#include <cstddef>
#include <vector>

namespace importon {

enum class Interpolation { step, linear, cubicSpline };

struct KeyTrack {
  Interpolation interpolation = Interpolation::linear;
  std::size_t width = 1;      // numbers of a value
  bool isRotation = false;    // values are quaternions x, y, z, w
  std::vector<float> times;   // s, one at least, not falling
  std::vector<float> values;  // finite; of each key a value, or of a spline in-tangent, value and out-tangent
};

/// The value at a time (glTF 2.0, section 3.11 and appendix C): before the first key and after the last theirs. Linear
/// rotations go at constant speed along the shorter way, and all are of unit length; one without a direction is none.
[[nodiscard]] std::vector<double> valueAt(const KeyTrack& track, double seconds);

}  // namespace importon
