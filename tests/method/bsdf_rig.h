/// Asks lib/bsdf.glsl for values and samples of a material.
#pragma once
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "support/statistics.h"

namespace importon::bsdf_test {

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
  vec3 diffuseTransmissionColor{1};
  float diffuseTransmission = 0;
  vec3 sheenColor{0};
  float sheenAlpha = 1;
  vec2 stretch{0};
  float iridescence = 0, filmIor = 1.3f, filmThickness = 400;
  vec3 sheetDepth{0};
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

[[nodiscard]] Query rough(float roughness, float metallic);
[[nodiscard]] Query roughGlass(bool isFront);
[[nodiscard]] Query coated(Query material, float roughness);

/// Directions from which materials are seen.
[[nodiscard]] const std::vector<vec3>& outgoing();

class BsdfTest : public test::GpuTest {
 protected:
  static void TearDownTestSuite();

  [[nodiscard]] std::vector<Answer> ask(const std::vector<Query>& queries) const;
  /// Answers to `material` with random numbers on a grid of side³ with a random shift in each cell.
  [[nodiscard]] std::vector<Answer> sample(const Query& material, const vec3& wo, int side) const;
  [[nodiscard]] std::vector<Answer> sampleFreely(const Query& material, const vec3& wo, int count) const;

  /// Tests that sampled directions have the density that evaluation states, at significance 1e-4.
  void expectDensity(const Case& c, const vec3& wo) const;
  /// Tests that the weight of samples is their value over their density.
  void expectWeights(const Case& c) const;
  /// Tests that reflection between random directions is the same both ways.
  void expectReciprocal(const Case& c, std::mt19937& random) const;
  /// Light of each channel that a surface shows along a direction under light of radiance 1 from everywhere.
  [[nodiscard]] std::vector<test::Moments> furnaces(const Query& material, const vec3& wo) const;
  [[nodiscard]] test::Moments furnace(const Query& material, float cosine) const;

 private:
  const gpu::Kernel& kernel() const;
  static std::optional<gpu::Kernel> sharedKernel;
};

/// What interpolation in the tables of directional albedo may be off by: of light from outside, and of light from
/// inside a solid, whose table bends sharply at the critical angle.
constexpr double kTable = 0.004, kInnerTable = 0.006;
/// And of what coats take: a base under an interface counts as diffuse there.
constexpr double kCoatTable = 0.01;

/// That the mean may lie within the bounds, at significance 1e-6 for each of hundreds of cases.
[[nodiscard]] ::testing::AssertionResult liesWithin(const test::Moments& light, double low, double high);

}  // namespace importon::bsdf_test
