#include "support/claims.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "support/stability.h"

namespace importon::test {
namespace {

::testing::AssertionResult judge(const Equivalence& found, const std::string& figures) {
  const double power = found.power(kClaimSignificance);
  const std::string text = fmt::format("{}: ratio {:.5f} +- {:.5f}, margin {:.4f}, p = {:.1e}, power {:.4f}", figures,
                                       found.ratio, found.standardError, found.margin, found.pValue, power);
  const double most = found.margin - studentPoint(kClaimSignificance, found.degreesOfFreedom) * found.standardError;
  noteCheck(text, most > 0 ? 1 - std::abs(found.ratio - 1) / most : -1);
  if (power < kLeastPower) return ::testing::AssertionFailure() << "underpowered: " << text;
  if (!(found.pValue <= kClaimSignificance)) return ::testing::AssertionFailure() << "not shown to be equal: " << text;
  return ::testing::AssertionSuccess() << text;
}

std::string describe(const Moments& m) {
  return fmt::format("{:.6g} +- {:.2g} (n = {})", m.mean(), m.standardError(), m.count());
}

::testing::AssertionResult judgeOneSided(const Moments& values, double bound, bool isOnItsSide, const char* side) {
  const double p = isOnItsSide ? 0.5 * tTest(values, bound).pValue : 1;
  const std::string text = fmt::format("{} {} {:.6g}: p = {:.1e}", describe(values), side, bound, p);
  if (p <= kClaimSignificance) return ::testing::AssertionSuccess() << text;
  return ::testing::AssertionFailure() << "not shown: " << text;
}

}  // namespace

::testing::AssertionResult isWithin(double margin, const Moments& values, double expected) {
  return judge(equivalenceTest(values, expected, margin),
               fmt::format("{}, expected {:.6g}", describe(values), expected));
}

::testing::AssertionResult areWithin(double margin, const Moments& a, const Moments& b) {
  return judge(equivalenceTest(a, b, margin), fmt::format("{} and {}", describe(a), describe(b)));
}

::testing::AssertionResult isAbove(double bound, const Moments& values) {
  return judgeOneSided(values, bound, values.mean() > bound, "above");
}

::testing::AssertionResult isBelow(double bound, const Moments& values) {
  return judgeOneSided(values, bound, values.mean() < bound, "below");
}

}  // namespace importon::test
