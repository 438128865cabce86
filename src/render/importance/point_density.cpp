#include "render/importance/point_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace importon {
namespace {

constexpr int kLevels = kZOrderLevels;
constexpr std::ptrdiff_t kFewest = 16;  // points in a cube

}  // namespace

PointDensity::PointDensity(std::span<const vec3> points, std::span<const float> weights, vec3 origin, float extent)
    : origin_(origin), extent_(extent) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {zOrderCode(points[i], origin, extent), i};
  std::sort(order.begin(), order.end());
  double sum = 0;
  sums_.push_back(0);
  for (const auto& [code, point] : order) {
    codes_.push_back(code);
    sums_.push_back(sum += static_cast<double>(weights[point]));
  }
}

double PointDensity::at(vec3 position) const {
  const std::uint32_t code = zOrderCode(position, origin_, extent_);
  auto begin = codes_.begin(), end = codes_.end();
  int level = 0;
  while (level < kLevels) {
    const int shift = 3 * (kLevels - level - 1);
    const std::uint32_t prefix = code >> shift;
    const auto low = std::lower_bound(begin, end, prefix << shift);
    const auto high = std::lower_bound(low, end, (prefix + 1) << shift);
    if (high - low < kFewest) break;
    begin = low;
    end = high;
    ++level;
  }
  const double edge = std::ldexp(static_cast<double>(extent_), -level);
  return (sums_[static_cast<std::size_t>(end - codes_.begin())] -
          sums_[static_cast<std::size_t>(begin - codes_.begin())]) /
         (edge * edge);
}

}  // namespace importon
