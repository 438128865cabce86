#include "support/special_functions.h"

#include <cassert>
#include <cmath>
#include <functional>

namespace importon::test {
namespace {

constexpr int kMostTerms = 100000;
constexpr double kPrecision = 1e-15;

/// P(a, x) by its power series [DLMF 8.11.4]; converges fast for x < a + 1.
double gammaSeries(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < kMostTerms && term > kPrecision * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// b0 + a1/(b1 + a2/(b2 + ...)) by the modified Lentz algorithm [Thompson and Barnett 1986].
double continuedFraction(double b0, const std::function<double(int)>& a, const std::function<double(int)>& b) {
  constexpr double kTiny = 1e-300;
  const auto awayFromZero = [](double v) { return v == 0 ? kTiny : v; };
  double result = awayFromZero(b0);
  double c = result;
  double d = 0;
  for (int n = 1; n < kMostTerms; ++n) {
    d = 1.0 / awayFromZero(b(n) + a(n) * d);
    c = awayFromZero(b(n) + a(n) / c);
    const double factor = c * d;
    result *= factor;
    if (std::abs(factor - 1.0) < kPrecision) break;
  }
  return result;
}

/// Q(a, x) by its continued fraction [DLMF 8.9.2, even part]; converges fast for x > a + 1.
double gammaFraction(double a, double x) {
  const double fraction = continuedFraction(
      x + 1.0 - a, [a](int n) { return -n * (n - a); }, [a, x](int n) { return x + 2.0 * n + 1.0 - a; });
  return std::exp(a * std::log(x) - x - std::lgamma(a)) / fraction;
}

/// The n-th coefficient of the continued fraction of I_x(a, b) [DLMF 8.17.23].
double betaCoefficient(double a, double b, double x, int n) {
  const double m = n / 2;
  if (n % 2 == 0) return m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
  return -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
}

/// Converges fast for x < (a + 1) / (a + b + 2) [DLMF 8.17.22].
double betaFraction(double a, double b, double x) {
  const double fraction = continuedFraction(
      1.0, [a, b, x](int n) { return betaCoefficient(a, b, x, n); }, [](int) { return 1.0; });
  const double logFront =
      a * std::log(x) + b * std::log1p(-x) - (std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b));
  return std::exp(logFront) / (a * fraction);
}

}  // namespace

double regularizedGammaQ(double a, double x) {
  assert(a > 0 && x >= 0);
  if (x == 0) return 1.0;
  return x < a + 1.0 ? 1.0 - gammaSeries(a, x) : gammaFraction(a, x);
}

double regularizedBeta(double a, double b, double x) {
  assert(a > 0 && b > 0 && x >= 0 && x <= 1);
  if (x == 0 || x == 1) return x;
  if (x < (a + 1.0) / (a + b + 2.0)) return betaFraction(a, b, x);
  return 1.0 - betaFraction(b, a, 1.0 - x);
}

}  // namespace importon::test
