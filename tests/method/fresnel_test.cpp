// lib/fresnel.glsl against closed values.
#include <gtest/gtest.h>

#include <cmath>

#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

/// As in tests/kernels/fresnel.comp.
struct Incidence {
  float cosine, eta, f0 = 0.04f, f90 = 1;
};
struct Reflectances {
  float dielectric, schlick;
};

class Fresnel : public test::GpuTest {
 protected:
  Reflectances at(double cosine, double eta) const {
    const std::vector<Incidence> q{{static_cast<float>(cosine), static_cast<float>(eta)}};
    return test::runKernel<Reflectances>(context(), test_kernels::code("fresnel"), q).front();
  }
};

TEST_F(Fresnel, AtNormalIncidenceIsTheSquareOfTheIndexContrast) {
  for (const double n : {1.33, 1.5, 2.4, 1 / 1.5})
    EXPECT_NEAR(at(1, n).dielectric, std::pow((n - 1) / (n + 1), 2), 1e-6);
}

TEST_F(Fresnel, AtBrewstersAngleOnlyOnePolarisationReflects) {
  const double n = 1.5, perpendicular = (1 - n * n) / (1 + n * n);
  EXPECT_NEAR(at(1 / std::hypot(1.0, n), n).dielectric, 0.5 * perpendicular * perpendicular, 1e-6);
}

TEST_F(Fresnel, IsOneAtGrazingAndTotalReflection) {
  EXPECT_NEAR(at(0, 1.5).dielectric, 1, 1e-6);
  EXPECT_EQ(at(0.7, 1 / 1.5).dielectric, 1.0f);  // beyond the critical angle, whose cosine is 0.745
  EXPECT_LT(at(0.76, 1 / 1.5).dielectric, 1.0f);
}

TEST_F(Fresnel, IsZeroWithoutContrast) {
  for (const double cosine : {0.1, 0.5, 1.0}) EXPECT_NEAR(at(cosine, 1).dielectric, 0, 1e-6);
}

TEST_F(Fresnel, IsTheSameFromBothSides) {
  for (const double cosine : {0.2, 0.5, 0.9}) {
    const double cosineBehind = std::sqrt(1 - (1 - cosine * cosine) / (1.5 * 1.5));
    EXPECT_NEAR(at(cosine, 1.5).dielectric, at(cosineBehind, 1 / 1.5).dielectric, 2e-6);
  }
}

TEST_F(Fresnel, SchlickHasItsEndsAndItsMiddle) {
  EXPECT_NEAR(at(1, 1).schlick, 0.04, 1e-7);
  EXPECT_NEAR(at(0, 1).schlick, 1, 1e-6);
  EXPECT_NEAR(at(0.5, 1).schlick, 0.04 + 0.96 / 32, 1e-6);
}

}  // namespace
}  // namespace importon
