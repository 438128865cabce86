/// The incomplete gamma and beta functions, from which p-values come.
#pragma once

namespace importon::test {

/// Q(a, x) = Γ(a, x) / Γ(a), the upper regularised incomplete gamma function; a > 0, x >= 0. Relative error
/// about 1e-12.
[[nodiscard]] double regularizedGammaQ(double a, double x);

/// I_x(a, b), the regularised incomplete beta function; a, b > 0, 0 <= x <= 1. Relative error about 1e-12.
[[nodiscard]] double regularizedBeta(double a, double b, double x);

}  // namespace importon::test
