#include "method/bsdf_rig.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "method/sphere_histogram.h"
#include "render/device_scene/albedo_table.h"
#include "test_kernels/registry.h"

namespace importon::bsdf_test {

Query rough(float roughness, float metallic) {
  Query q;
  q.alpha = roughness * roughness;
  q.metallic = metallic;
  return q;
}

Query roughGlass(bool isFront) {
  Query q = rough(0.6f, 0);
  q.baseColor = vec3(1);
  q.transmission = 1;
  q.isFront = isFront;
  return q;
}

Query coated(Query material, float roughness) {
  material.coat = 1;
  material.coatAlpha = roughness * roughness;
  return material;
}

const std::vector<vec3>& outgoing() {
  static const std::vector<vec3> kDirections{vec3(0, 0, 1), glm::normalize(vec3(0.5f, 0.2f, 0.8f)),
                                             glm::normalize(vec3(-0.3f, 0.9f, 0.35f))};
  return kDirections;
}

std::optional<gpu::Kernel> BsdfTest::sharedKernel;

void BsdfTest::TearDownTestSuite() { sharedKernel.reset(); }

/// Compiled once for all tests of a suite.
const gpu::Kernel& BsdfTest::kernel() const {
  if (!sharedKernel) sharedKernel.emplace(context(), "BSDF", test_kernels::code("bsdf"));
  return *sharedKernel;
}

std::vector<Answer> BsdfTest::ask(const std::vector<Query>& queries) const {
  const gpu::Buffer input = gpu::makeBuffer(context(), "queries", std::span<const Query>(queries));
  const gpu::Buffer output(context(), "answers", queries.size() * sizeof(Answer));
  const gpu::Buffer albedo = gpu::makeBuffer(context(), "albedo", albedoTable(), gpu::TexelFormat::uint1);
  const gpu::Buffer* const bindings[] = {&input, &output, &albedo};
  gpu::Recorder recorder(context());
  recorder.dispatch(kernel(), bindings, queries.size(), static_cast<std::uint32_t>(queries.size()));
  recorder.submitAndWait();
  return output.download<Answer>(queries.size());
}

std::vector<Answer> BsdfTest::sample(const Query& material, const vec3& wo, int side) const {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit;
  const auto at = [&](int i) { return static_cast<float>(std::min((i + unit(random)) / side, 0.99999994)); };
  std::vector<Query> queries;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      for (int k = 0; k < side; ++k) {
        Query q = material;
        q.wo = wo;
        q.u = vec2(at(i), at(j));
        q.uLobe = at(k);
        queries.push_back(q);
      }
    }
  }
  return ask(queries);
}

std::vector<Answer> BsdfTest::sampleFreely(const Query& material, const vec3& wo, int count) const {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 0.99999994f);
  std::vector<Query> queries(static_cast<std::size_t>(count), material);
  for (Query& q : queries) {
    q.wo = wo;
    q.u = vec2(unit(random), unit(random));
    q.uLobe = unit(random);
  }
  return ask(queries);
}

void BsdfTest::expectDensity(const Case& c, const vec3& wo) const {
  constexpr int kSamples = 200'000;
  const vec3 axis = c.sharp ? vec3(-wo.x, -wo.y, wo.z) : vec3(0, 0, 1);
  test::SphereHistogram cells(axis, c.sharp ? static_cast<double>(c.material.alpha) : 1.0, 20, 20);
  double deltas = 0;
  for (const Answer& a : sampleFreely(c.material, wo, kSamples)) {
    if (a.isDelta != 0)
      ++deltas;
    else if (a.sampledPdf > 0)
      cells.add(a.sampled);
  }
  std::vector<Query> queries;
  for (const vec3& wi : cells.quadrature()) {
    queries.push_back(c.material);
    queries.back().wo = wo;
    queries.back().wi = wi;
  }
  std::vector<double> densities;
  for (const Answer& a : ask(queries)) densities.push_back(a.pdf);
  cells.expect(densities, kSamples);
  EXPECT_LE(cells.integral(kSamples) + deltas / kSamples, 1.01);
  EXPECT_GT(cells.pValue(kSamples), 1e-4);
}

void BsdfTest::expectWeights(const Case& c) const {
  auto answers = sampleFreely(c.material, outgoing()[1], 2000);
  std::vector<Query> queries(answers.size(), c.material);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    queries[i].wo = outgoing()[1];
    queries[i].wi = answers[i].sampled;
  }
  const auto again = ask(queries);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer& a = answers[i];
    if (a.isDelta != 0 || a.sampledPdf <= 0) continue;
    ASSERT_NEAR(again[i].pdf / a.sampledPdf, 1, 1e-3) << c.name;
    ASSERT_NEAR(glm::length(a.weight * a.sampledPdf - again[i].value), 0, 1e-3 * glm::length(again[i].value) + 1e-6)
        << c.name;
    ASSERT_EQ(a.isTransmission != 0, a.sampled.z < 0) << c.name;
  }
}

void BsdfTest::expectReciprocal(const Case& c, std::mt19937& random) const {
  std::uniform_real_distribution<float> side(-1, 1), height(0.02f, 1);
  std::vector<Query> there(5000, c.material), back;
  for (Query& q : there) {
    q.wo = glm::normalize(vec3(side(random), side(random), height(random)));
    q.wi = glm::normalize(vec3(side(random), side(random), height(random)));
    back.push_back(q);
    std::swap(back.back().wo, back.back().wi);
    back.back().isAdjoint = 1;  // of photons; it counts where the coat has a normal of its own
  }
  const auto a = ask(there), b = ask(back);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const vec3& normal = c.material.coatNormal;
    const bool isBounded = std::min(glm::dot(there[i].wo, normal), glm::dot(there[i].wi, normal)) < 0.3f;
    if (normal.z < 1.0f && isBounded) continue;
    for (int channel = 0; channel < 3; ++channel) {
      const double f = static_cast<double>(a[i].value[channel] / there[i].wi.z),
                   g = static_cast<double>(b[i].value[channel] / there[i].wo.z);
      ASSERT_NEAR(f, g, 1e-4 * std::max(f, g)) << c.name;
    }
  }
}

std::vector<test::Moments> BsdfTest::furnaces(const Query& material, const vec3& wo) const {
  std::vector<test::Moments> light(3);
  for (const Answer& a : sample(material, wo, 16))
    for (int c = 0; c < 3; ++c) light[static_cast<std::size_t>(c)].add(static_cast<double>(a.weight[c]));
  return light;
}

test::Moments BsdfTest::furnace(const Query& material, float cosine) const {
  return furnaces(material, vec3(std::sqrt(1 - cosine * cosine), 0, cosine))[0];
}

::testing::AssertionResult liesWithin(const test::Moments& light, double low, double high) {
  const double nearest = std::clamp(light.mean(), low, high);
  if (test::zTest(light.mean(), light.standardError(), nearest).pValue > 1e-6) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << light.mean() << " +- " << light.standardError();
}

}  // namespace importon::bsdf_test
