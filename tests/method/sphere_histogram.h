/// Cells of directions for chi-square tests of sampled directions against a density.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "shared/scene_data.h"

namespace importon::test {

/// Cells around an axis, as fine near it as the lobe at hand asks: tan(θ/2) = width ξ/(1-ξ), equal steps in ξ
/// and in the azimuth; they cover the whole sphere.
class SphereHistogram {
 public:
  SphereHistogram(const vec3& axis, double width, int rings, int sectors);

  void add(const vec3& direction) { observed_[cellOf(direction)] += 1; }
  /// Directions at which the density is needed for expect(): the midpoints of `kFine` x `kFine` parts of each cell.
  [[nodiscard]] std::vector<vec3> quadrature() const;
  /// Takes the densities (1/sr) at quadrature(); counts expected of `samples` directions in all.
  void expect(const std::vector<double>& densities, double samples);
  /// p of the hypothesis that the directions have this density; those never added (of `samples`) fall to a cell of
  /// their own.
  [[nodiscard]] double pValue(double samples) const;
  /// What of the density the cells hold.
  [[nodiscard]] double integral(double samples) const;

 private:
  static constexpr int kFine = 16;
  [[nodiscard]] std::size_t cellOf(const vec3& direction) const;

  glm::dvec3 axis_, tangent_, bitangent_;
  double width_;
  int rings_, sectors_;
  std::vector<double> observed_, expected_;
};

}  // namespace importon::test
