// lib/bsdf.glsl: sampling has the density that evaluation states, energy is not gained, reflection is reciprocal.
// Significance of each chi-square test: 1e-4.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "method/sphere_histogram.h"
#include "render/device_scene/albedo_table.h"
#include "support/gpu_test.h"
#include "support/statistics.h"
#include "test_kernels/registry.h"

namespace importon::bsdf_test {
namespace {

/// As in tests/kernels/bsdf.comp.
struct Query {
  vec3 baseColor{0.8f};
  float metallic = 0, alpha = 1, transmission = 0, ior = 1.5f, specular = 1;
  uint isFront = 1, isSolid = 1;
  vec3 wo{0, 0, 1}, wi{0, 0, 1};
  vec2 u{0.5f};
  float uLobe = 0.5f;
  float coat = 0, coatAlpha = 0;
  vec3 coatNormal{0, 0, 1};
  uint isAdjoint = 0;
  vec3 specularColor{1};
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

Query coated(Query material, float roughness) {
  material.coat = 1;
  material.coatAlpha = roughness * roughness;
  return material;
}

std::vector<Case> cases() {
  Query lambert;
  lambert.specular = 0;
  Query mixed = roughGlass(true);
  mixed.transmission = 0.5f;
  Query sheet = roughGlass(true);
  sheet.isSolid = 0;
  Query tilted = coated(rough(0.6f, 1), 0.4f);
  tilted.coatNormal = glm::normalize(vec3(0.2f, -0.1f, 1));
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
          {"rough sheet", sheet},
          {"smooth clear coat over rough metal", coated(rough(0.6f, 1), 0)},
          {"clear coat over rough base", coated(rough(0.8f, 0), 0.4f)},
          {"rough clear coat over mirror", coated(rough(0, 1), 0.5f)},
          {"coated sheet", coated(sheet, 0.5f)},
          {"clear coat of another normal", tilted}};
}

const std::vector<vec3>& outgoing() {
  static const std::vector<vec3> directions{vec3(0, 0, 1), glm::normalize(vec3(0.5f, 0.2f, 0.8f)),
                                            glm::normalize(vec3(-0.3f, 0.9f, 0.35f))};
  return directions;
}

class BsdfTest : public test::GpuTest {
 protected:
  static void TearDownTestSuite() { kernel_.reset(); }

  /// Compiled once for all tests.
  const gpu::Kernel& kernel() const {
    if (!kernel_) kernel_.emplace(context(), "BSDF", test_kernels::code("bsdf"));
    return *kernel_;
  }

  std::vector<Answer> ask(const std::vector<Query>& queries) const {
    const gpu::Buffer input = gpu::makeBuffer(context(), "queries", std::span<const Query>(queries));
    const gpu::Buffer output(context(), "answers", queries.size() * sizeof(Answer));
    const gpu::Buffer albedo = gpu::makeBuffer(context(), "albedo", albedoTable(), gpu::TexelFormat::uint1);
    const gpu::Buffer* const bindings[] = {&input, &output, &albedo};
    gpu::Recorder recorder(context());
    recorder.dispatch(kernel(), bindings, queries.size(), static_cast<std::uint32_t>(queries.size()));
    recorder.submitAndWait();
    return output.download<Answer>(queries.size());
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

  /// Light that a white surface shows under light of radiance 1 from everywhere.
  test::Moments furnace(const Query& material, float cosine) const {
    test::Moments light;
    const auto answers = sample(material, vec3(std::sqrt(1 - cosine * cosine), 0, cosine), 16);
    for (const Answer& a : answers) light.add(static_cast<double>(a.weight.x));
    return light;
  }

 private:
  static std::optional<gpu::Kernel> kernel_;
};

std::optional<gpu::Kernel> BsdfTest::kernel_;

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

/// White materials that absorb nothing, of one roughness and index.
std::vector<Case> whiteCases(float roughness, float ior) {
  Query coat = rough(roughness, 0);
  coat.baseColor = vec3(1);
  coat.ior = ior;
  Query metal = coat, half = coat, sheet = coat;
  metal.metallic = 1;
  half.metallic = 0.5f;
  sheet.transmission = 1;
  sheet.isSolid = 0;
  Query mixed = sheet, front = sheet;
  mixed.transmission = 0.5f;
  front.isSolid = 1;
  Query back = front;
  back.isFront = 0;
  return {{"metal", metal},           {"base under interface", coat}, {"half metallic", half},
          {"sheet", sheet},           {"half transmitting", mixed},   {"solid from outside", front},
          {"solid from inside", back}};
}

/// What interpolation in the tables of directional albedo may be off by: of light from outside, and of light from
/// inside a solid, whose table bends sharply at the critical angle.
constexpr double kTable = 0.004, kInnerTable = 0.006;
/// And of what coats take: a base under an interface counts as diffuse there.
constexpr double kCoatTable = 0.01;

/// That the mean may lie within the bounds, at significance 1e-6 for each of the hundreds of cases.
::testing::AssertionResult liesWithin(const test::Moments& light, double low, double high) {
  const double nearest = std::clamp(light.mean(), low, high);
  if (test::zTest(light.mean(), light.standardError(), nearest).pValue > 1e-6) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << light.mean() << " +- " << light.standardError();
}

// Light that microfacets scatter more than once is not lost.
TEST_F(BsdfTest, WhiteSurfacesKeepAllLightAtEveryRoughness) {
  for (int step = 0; step <= 8; ++step) {
    for (const float ior : {1.0f, 1.33f, 1.7f, 2.5f}) {
      for (const Case& c : whiteCases(static_cast<float>(step) / 8, ior)) {
        const double table = c.material.isFront != 0 ? kTable : kInnerTable;
        for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f, 0.05f})
          EXPECT_TRUE(liesWithin(furnace(c.material, cosine), 1 - table, 1 + table))
              << c.name << ", roughness " << step / 8.0 << ", ior " << ior << ", cosine " << cosine;
      }
    }
  }
}

// The white furnace: under light of radiance 1 from everywhere a white surface shows at most 1.
TEST_F(BsdfTest, GainsNoEnergyInAnyDirection) {
  std::vector<Case> all = cases();
  all.push_back({"rough glass without reflection", roughGlass(true)});
  all.back().material.specular = 0;
  for (const Case& c : all) {
    for (const float cosine : {1.0f, 0.8f, 0.5f, 0.25f, 0.1f, 0.03f}) {
      Query white = c.material;
      white.baseColor = vec3(1);
      EXPECT_TRUE(liesWithin(furnace(white, cosine), 0, 1 + (white.isFront != 0 ? kTable : kInnerTable)))
          << c.name << ", cosine " << cosine;
    }
  }
}

// What a coat takes too much of, where light comes in more grazingly than it leaves, comes back.
TEST_F(BsdfTest, CoatedWhiteSurfacesKeepTheirLight) {
  for (const float coatRoughness : {0.0f, 0.3f, 0.7f, 1.0f}) {
    for (const float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
      for (const float metallic : {0.0f, 1.0f}) {
        Query white = coated(rough(roughness, metallic), coatRoughness);
        white.baseColor = vec3(1);
        for (const float cosine : {1.0f, 0.7f, 0.4f, 0.1f})
          EXPECT_TRUE(liesWithin(furnace(white, cosine), 1 - kCoatTable, 1 + kCoatTable))
              << "coat " << coatRoughness << " over " << roughness << ", metallic " << metallic << ", cosine "
              << cosine;
      }
    }
  }
}

TEST_F(BsdfTest, BlackDielectricReflectsTheSquareOfTheIndexContrast) {
  for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f}) {
    Query smooth;
    smooth.baseColor = vec3(0);
    smooth.alpha = 0;
    smooth.ior = ior;
    const Answer a = ask({smooth}).front();
    EXPECT_NEAR(a.weight.x, std::pow((ior - 1) / (ior + 1), 2), 1e-6) << "index " << ior;
  }
}

// KHR_materials_specular weakens or colours what a dielectric reflects; the rest passes.
TEST_F(BsdfTest, SpecularOfGlassMovesLightFromReflectionToTransmission) {
  Query glass = roughGlass(true);
  glass.alpha = 0;
  glass.specular = 0.5f;
  glass.specularColor = vec3(0.5f, 1, 2);
  for (const uint isFront : {1u, 0u}) {
    glass.isFront = isFront;
    const auto answers = sampleFreely(glass, vec3(0, 0, 1), 20000);
    for (int c = 0; c < 3; ++c) {
      test::Moments reflected, all;
      for (const Answer& a : answers) {
        reflected.add(a.isTransmission != 0 ? 0.0 : static_cast<double>(a.weight[c]));
        all.add(static_cast<double>(a.weight[c]));
      }
      const double expected = 0.04 * 0.5 * static_cast<double>(glass.specularColor[c]);
      EXPECT_TRUE(liesWithin(reflected, expected, expected));
      EXPECT_TRUE(liesWithin(all, 1, 1));
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
      back.back().isAdjoint = 1;  // of photons; it counts where the coat has a normal of its own
    }
    const auto a = ask(there), b = ask(back);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const vec3& normal = c.material.coatNormal;
      const bool isBounded = std::min(glm::dot(there[i].wo, normal), glm::dot(there[i].wi, normal)) < 0.3f;
      if (normal.z < 1.0f && isBounded) continue;
      const double f = static_cast<double>(a[i].value.x / there[i].wi.z),
                   g = static_cast<double>(b[i].value.x / there[i].wo.z);
      ASSERT_NEAR(f, g, 1e-4 * std::max(f, g)) << c.name;
    }
  }
}

// Flux that goes through, and back: equal but for the squared relative index. [Veach 1997, eq. 5.14]
TEST_F(BsdfTest, RoughTransmissionIsReciprocalUpToTheSquaredIndex) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> side(-1, 1), height(0.05f, 1);
  for (const bool isSolid : {true, false}) {
    std::vector<Query> there(5000, roughGlass(true)), back;
    for (Query& q : there) {
      q.isSolid = isSolid ? 1 : 0;
      q.wo = glm::normalize(vec3(side(random), side(random), height(random)));
      q.wi = glm::normalize(vec3(side(random), side(random), -height(random)));
      back.push_back(q);
      back.back().isFront = isSolid ? 0 : 1;
      back.back().wo = vec3(q.wi.x, q.wi.y, -q.wi.z);
      back.back().wi = vec3(q.wo.x, q.wo.y, -q.wo.z);
    }
    const auto a = ask(there), b = ask(back);
    const double square = isSolid ? 1.5 * 1.5 : 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double f = static_cast<double>(a[i].value.x / -there[i].wi.z) / square;
      const double g = static_cast<double>(b[i].value.x / there[i].wo.z);
      ASSERT_NEAR(f, g, 1e-3 * std::max(f, g)) << isSolid;  // float rounding of sharp peaks
    }
  }
}

}  // namespace
}  // namespace importon::bsdf_test
