/// The mean that every error of the program is: without the few pixels that would be most of it.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace importon {

/// How many of `count` values stay: all but the greatest thousandth.
[[nodiscard]] inline std::size_t keptWhenTrimmed(std::size_t count) { return count - count / 1000; }

/// Mean of all but the greatest thousandth of `values`, of which there is at least one.
[[nodiscard]] inline double trimmedMean(std::vector<double> values) {
  const auto kept = static_cast<std::ptrdiff_t>(keptWhenTrimmed(values.size()));
  std::nth_element(values.begin(), values.begin() + kept - 1, values.end());
  return std::accumulate(values.begin(), values.begin() + kept, 0.0) / static_cast<double>(kept);
}

}  // namespace importon
