#include "scene/animation/slerp.h"

#include <cmath>

namespace importon {

double portableSine(double x) {
  constexpr int kTerms = 13;  // (pi/2)^27 / 27! is 2e-23
  const double square = x * x;
  double sum = 1;
  for (int k = kTerms; k > 0; --k) sum = 1 - square / ((2.0 * k) * (2.0 * k + 1)) * sum;
  return x * sum;
}

double portableArctangent(double x) {
  // tan(a/2) = tan(a) / (1 + sqrt(1 + tan(a)^2)): four halvings leave at most tan(pi/64) = 0.05
  constexpr int kHalvings = 4, kTerms = 6;  // 0.05^13 / 13 is 1e-18
  for (int i = 0; i < kHalvings; ++i) x = x / (1 + std::sqrt(1 + x * x));
  const double square = x * x;
  double sum = 1.0 / (2 * kTerms + 1);
  for (int k = kTerms - 1; k >= 0; --k) sum = 1.0 / (2 * k + 1) - square * sum;
  return x * sum * (1 << kHalvings);
}

glm::dvec4 slerp(const glm::dvec4& a, const glm::dvec4& b, double share) {
  const glm::dvec4 end = glm::dot(a, b) < 0 ? -b : b;  // q and -q are the same rotation
  // The angle by its half, whose tangent has no cancellation, whether the two are near or far.
  const double half = glm::length(end - a) / glm::length(end + a);
  const double angle = 2 * portableArctangent(half);
  if (!(angle > 0)) return a;
  const double whole = portableSine(angle);
  return a * (portableSine((1 - share) * angle) / whole) + end * (portableSine(share * angle) / whole);
}

}  // namespace importon
