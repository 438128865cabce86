// lib/bsdf.glsl: sampling has the density that evaluation states, energy is not gained, reflection is reciprocal.
// Significance of each chi-square test: 1e-4.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "method/bsdf_rig.h"

namespace importon::bsdf_test {
namespace {

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

TEST_F(BsdfTest, SampledDirectionsHaveTheStatedDensity) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    expectDensity(c, outgoing()[2]);
  }
}

TEST_F(BsdfTest, SampledDirectionsHaveTheStatedDensityFromAbove) {
  for (const Case& c : cases()) {
    for (const std::size_t direction : {0u, 1u}) {
      SCOPED_TRACE(c.name + ", direction " + std::to_string(direction));
      expectDensity(c, outgoing()[direction]);
    }
  }
}

TEST_F(BsdfTest, WeightsAreTheValueOverTheDensity) {
  for (const Case& c : cases()) expectWeights(c);
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

// Light that microfacets scatter more than once is not lost.
TEST_F(BsdfTest, WhiteSurfacesKeepAllLightAtEveryRoughness) {
  for (int step = 0; step <= 8; ++step) {
    for (const float ior : {1.33f, 2.5f}) {
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
  for (const Case& c : cases())
    if (c.material.transmission == 0) expectReciprocal(c, random);
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
