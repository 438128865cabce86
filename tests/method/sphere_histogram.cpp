#include "method/sphere_histogram.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon::test {

SphereHistogram::SphereHistogram(const vec3& axis, double width, int rings, int sectors)
    : axis_(glm::normalize(glm::dvec3(axis))),
      width_(width),
      rings_(rings),
      sectors_(sectors),
      observed_(static_cast<std::size_t>(rings * sectors)),
      expected_(observed_.size()) {
  tangentFrame(axis_, tangent_, bitangent_);
}

std::size_t SphereHistogram::cellOf(const vec3& direction) const {
  const glm::dvec3 d(direction);
  const double x = glm::dot(d, tangent_), y = glm::dot(d, bitangent_), z = glm::dot(d, axis_);
  const double t = std::hypot(x, y) / (std::max(1 + z, 0.0) + 1e-300);
  const double xi = t / (t + width_);
  const double azimuth = std::atan2(y, x) / (2 * M_PI) + 0.5;
  const int ring = std::clamp(static_cast<int>(xi * rings_), 0, rings_ - 1);
  const int sector = std::clamp(static_cast<int>(azimuth * sectors_), 0, sectors_ - 1);
  return static_cast<std::size_t>(ring * sectors_ + sector);
}

std::vector<vec3> SphereHistogram::quadrature() const {
  std::vector<vec3> directions;
  for (int i = 0; i < rings_ * kFine; ++i) {
    const double xi = (i + 0.5) / (rings_ * kFine), t = width_ * xi / (1 - xi);
    const double sine = 2 * t / (1 + t * t), cosine = (1 - t * t) / (1 + t * t);
    for (int j = 0; j < sectors_ * kFine; ++j) {
      const double azimuth = 2 * M_PI * ((j + 0.5) / (sectors_ * kFine) - 0.5);
      directions.emplace_back(sine * (std::cos(azimuth) * tangent_ + std::sin(azimuth) * bitangent_) + cosine * axis_);
    }
  }
  return directions;
}

void SphereHistogram::expect(const std::vector<double>& densities, double samples) {
  const int columns = sectors_ * kFine;
  for (int i = 0; i < rings_ * kFine; ++i) {
    const double step = 1.0 / (rings_ * kFine), xi = (i + 0.5) * step, t = width_ * xi / (1 - xi);
    // dω = 4t/(1+t²)² dt dφ
    const double solidAngle =
        4 * t / std::pow(1 + t * t, 2) * width_ / ((1 - xi) * (1 - xi)) * step * 2 * M_PI / columns;
    for (int j = 0; j < columns; ++j)
      expected_[static_cast<std::size_t>(i / kFine * sectors_ + j / kFine)] +=
          samples * solidAngle * densities[static_cast<std::size_t>(i * columns + j)];
  }
}

double SphereHistogram::integral(double samples) const {
  return std::accumulate(expected_.begin(), expected_.end(), 0.0) / samples;
}

double SphereHistogram::pValue(double samples) const {
  std::vector<double> observed = observed_, expected = expected_;
  const double added = std::accumulate(observed.begin(), observed.end(), 0.0);
  observed.push_back(samples - added);
  expected.push_back(std::max(0.0, samples * (1 - integral(samples))));
  const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
  for (double& e : expected) e *= samples / total;
  return chiSquareTest(observed, expected).pValue;
}

}  // namespace importon::test
