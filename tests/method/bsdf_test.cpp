// lib/bsdf.glsl: sampling has the density that evaluation states, energy is not gained, reflection is reciprocal.
// Significance of each chi-square test: 1e-4.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "method/sphere_histogram.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

/// As in tests/kernels/bsdf.comp.
struct Query {
  vec3 baseColor{0.8f};
  float metallic = 0, alpha = 1, transmission = 0, ior = 1.5f, specular = 1;
  uint isFront = 1, isSolid = 1;
  vec3 wo{0, 0, 1}, wi{0, 0, 1};
  vec2 u{0.5f};
  float uLobe = 0.5f;
};
struct Answer {
  vec3 value;
  float pdf;
  vec3 sampled, weight;
  float sampledPdf;
  uint isDelta, isTransmission;
};

struct Case {
  std::string name;
  Query material;
  bool sharp = false;  // one narrow lobe of reflection
};

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

std::vector<Case> cases() {
  Query lambert;
  lambert.specular = 0;
  Query mixed = roughGlass(true);
  mixed.transmission = 0.5f;
  Query sheet = roughGlass(true);
  sheet.isSolid = 0;
  return {{"diffuse", lambert},
          {"metal of roughness 0.1", rough(0.1f, 1), true},
          {"metal of roughness 0.5", rough(0.5f, 1)},
          {"metal of roughness 1", rough(1, 1)},
          {"smooth coat over diffuse", rough(0, 0)},
          {"rough coat over diffuse", rough(0.5f, 0)},
          {"half metallic", rough(0.6f, 0.5f)},
          {"rough glass from the front", roughGlass(true)},
          {"rough glass from the back", roughGlass(false)},
          {"half transmitting", mixed},
          {"rough sheet", sheet}};
}

const std::vector<vec3>& outgoing() {
  static const std::vector<vec3> directions{vec3(0, 0, 1), glm::normalize(vec3(0.5f, 0.2f, 0.8f)),
                                            glm::normalize(vec3(-0.3f, 0.9f, 0.35f))};
  return directions;
}

class BsdfTest : public test::GpuTest {
 protected:
  std::vector<Answer> ask(const std::vector<Query>& queries) const {
    return test::runKernel<Answer>(context(), test_kernels::spirv("bsdf"), queries);
  }

  /// Answers to `material` with random numbers on a grid of side³ with a random shift in each cell.
  std::vector<Answer> sample(const Query& material, const vec3& wo, int side) const {
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

  std::vector<Answer> sampleFreely(const Query& material, const vec3& wo, int count) const {
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

  void expectDensity(const Case& c, const vec3& wo) const {
    constexpr int kSamples = 200'000;
    const vec3 axis = c.sharp ? vec3(-wo.x, -wo.y, wo.z) : vec3(0, 0, 1);
    test::SphereHistogram cells(axis, c.sharp ? static_cast<double>(c.material.alpha) : 1.0, 20, 20);
    double deltas = 0;
    for (const Answer& a : sampleFreely(c.material, wo, kSamples)) {
      if (a.isDelta != 0) ++deltas;
      else if (a.sampledPdf > 0) cells.add(a.sampled);
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
};

TEST_F(BsdfTest, SampledDirectionsHaveTheStatedDensity) {
  for (const Case& c : cases()) {
    for (const vec3& wo : outgoing()) {
      SCOPED_TRACE(c.name + ", wo.z " + std::to_string(wo.z));
      expectDensity(c, wo);
    }
  }
}

TEST_F(BsdfTest, WeightsAreTheValueOverTheDensity) {
  for (const Case& c : cases()) {
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
}

// The white furnace: under light of radiance 1 from everywhere a white surface shows at most 1.
TEST_F(BsdfTest, GainsNoEnergyInAnyDirection) {
  for (const Case& c : cases()) {
    for (const float cosine : {1.0f, 0.8f, 0.5f, 0.25f, 0.1f, 0.03f}) {
      Query white = c.material;
      white.baseColor = vec3(1);
      double sum = 0;
      const auto answers = sample(white, vec3(std::sqrt(1 - cosine * cosine), 0, cosine), 32);
      for (const Answer& a : answers) sum += a.weight.x;
      EXPECT_LE(sum / static_cast<double>(answers.size()), 1.003) << c.name << ", cosine " << cosine;
    }
  }
}

TEST_F(BsdfTest, DiffuseReflectsItsAlbedo) {
  const Case lambert = cases().front();
  for (const vec3& wo : outgoing()) {
    for (const Answer& a : sampleFreely(lambert.material, wo, 1000)) ASSERT_NEAR(a.weight.x, 0.8, 1e-5);
  }
}

TEST_F(BsdfTest, SmoothGlassSplitsAllLightBetweenReflectionAndRefraction) {
  Query glass = roughGlass(true);
  glass.alpha = 0;
  for (const uint isFront : {1u, 0u}) {
    glass.isFront = isFront;
    for (const vec3& wo : outgoing()) {
      double sum = 0;
      const auto answers = sample(glass, wo, 16);
      for (const Answer& a : answers) {
        sum += a.weight.x;
        ASSERT_EQ(a.isDelta, 1u);
        const double eta = isFront != 0 ? 1.5 : 1 / 1.5;
        const double sinIn = std::hypot(a.sampled.x, a.sampled.y), sinOut = std::hypot(wo.x, wo.y);
        ASSERT_NEAR(a.isTransmission != 0 ? sinIn * eta : sinIn, sinOut, 1e-5);  // Snell; mirror
      }
      EXPECT_NEAR(sum / static_cast<double>(answers.size()), 1, 1e-5);
    }
  }
}

TEST_F(BsdfTest, ReflectionIsReciprocal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> side(-1, 1), height(0.02f, 1);
  for (const Case& c : cases()) {
    if (c.material.transmission > 0) continue;
    std::vector<Query> there(5000, c.material), back;
    for (Query& q : there) {
      q.wo = glm::normalize(vec3(side(random), side(random), height(random)));
      q.wi = glm::normalize(vec3(side(random), side(random), height(random)));
      back.push_back(q);
      std::swap(back.back().wo, back.back().wi);
    }
    const auto a = ask(there), b = ask(back);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double f = static_cast<double>(a[i].value.x / there[i].wi.z), g = static_cast<double>(b[i].value.x / there[i].wo.z);
      ASSERT_NEAR(f, g, 1e-4 * std::max(f, g)) << c.name;
    }
  }
}

}  // namespace
}  // namespace importon
