// lib/ggx.glsl: visible normals have the density that pdfVisibleNormal states. Significance of each test: 1e-4.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "method/sphere_histogram.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon::ggx_test {
namespace {

/// As in tests/kernels/visible_normal.comp.
struct Query {
  vec3 wo;
  float alpha;
  vec2 u;
  vec3 h;
};
struct Answer {
  vec3 sampled;
  float pdf;
};

class VisibleNormals : public test::GpuTest {
 protected:
  std::vector<Answer> ask(const std::vector<Query>& queries) const {
    return test::runKernel<Answer>(context(), test_kernels::code("visible_normal"), queries);
  }

  void expectDensity(const vec3& wo, float alpha) {
    constexpr double kSamples = 100'000;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit;
    std::vector<Query> queries;
    for (int i = 0; i < static_cast<int>(kSamples); ++i)
      queries.push_back({wo, alpha, vec2(unit(random), unit(random)), vec3(0, 0, 1)});
    test::SphereHistogram cells(vec3(0, 0, 1), 0.5 * static_cast<double>(alpha), 12, 16);
    for (const Answer& a : ask(queries)) {
      ASSERT_GE(glm::dot(a.sampled, wo), -1e-4f) << "a normal that is not visible";
      cells.add(a.sampled);
    }
    queries.clear();
    for (const vec3& h : cells.quadrature()) queries.push_back({wo, alpha, vec2(0.5f), h.z > 0 ? h : vec3(1, 0, 0)});
    const auto answers = ask(queries);
    std::vector<double> densities;
    const auto directions = cells.quadrature();
    for (std::size_t i = 0; i < directions.size(); ++i) densities.push_back(directions[i].z > 0 ? answers[i].pdf : 0.0);
    cells.expect(densities, kSamples);
    EXPECT_NEAR(cells.integral(kSamples), 1, 5e-3) << "the density does not integrate to 1";
    EXPECT_GT(cells.pValue(kSamples), 1e-4);
  }
};

TEST_F(VisibleNormals, HaveTheirDensity) {
  for (const float alpha : {0.01f, 0.1f, 0.3f, 1.0f}) {
    for (const vec3& wo : {vec3(0, 0, 1), vec3(0.6f, 0, 0.8f), vec3(-0.5f, 0.7f, 0.3f), vec3(0, -1, 0.05f)}) {
      SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", wo.z " << wo.z);
      expectDensity(glm::normalize(wo), alpha);
    }
  }
}

}  // namespace
}  // namespace importon::ggx_test
