// Lobes of extensions in lib/bsdf.glsl, as bsdf_test.cpp tests the others: diffuse transmission, sheen, anisotropy and
// iridescence. Significance of each chi-square test: 1e-4.
#include <algorithm>
#include <cmath>
#include <random>

#include "method/bsdf_rig.h"

namespace importon::bsdf_test::layers_test {
namespace {

Query translucent(Query material, float share, const vec3& color = vec3(1)) {
  material.diffuseTransmission = share;
  material.diffuseTransmissionColor = color;
  return material;
}

Query sheened(Query material, const vec3& color, float roughness) {
  material.sheenColor = color;
  material.sheenAlpha = roughness * roughness;
  return material;
}

Query stretched(Query material, float strength, float angle = 0) {
  material.stretch = vec2(strength * strength, angle);
  return material;
}

Query filmed(Query material, float thickness, float ior = 1.3f) {
  material.iridescence = 1;
  material.filmThickness = thickness;
  material.filmIor = ior;
  return material;
}

Query white(Query material) {
  material.baseColor = vec3(1);
  return material;
}

Query solid(Query material, bool isFront) {
  material.isSolid = 1;
  material.isFront = isFront ? 1 : 0;
  return material;
}

Query thin(Query material) {
  material.isSolid = 0;
  return material;
}

/// A sheet of this optical thickness.
Query absorbing(Query material, const vec3& depth) {
  material.sheetDepth = depth;
  return material;
}

class LayersTest : public BsdfTest {};

std::vector<Case> layered() {
  const vec3 blue(0.2f, 0.4f, 0.9f);
  return {
      {"translucent", thin(translucent(rough(0.5f, 0), 0.6f, blue))},
      {"translucent solid that also is clear", translucent(roughGlass(true), 0.5f)},
      {"sheen over diffuse", thin(sheened(rough(0.8f, 0), blue, 0.5f))},
      {"sharp sheen over translucent metal", thin(sheened(translucent(rough(0.4f, 0.5f), 0.5f), blue, 0.2f))},
      {"stretched metal", thin(stretched(rough(0.4f, 1), 0.7f, 0.6f))},
      {"stretched interface", thin(stretched(rough(0.5f, 0), 0.5f, -1))},
      {"stretched glass", stretched(roughGlass(true), 0.5f, 0.3f)},
      {"film over metal", thin(filmed(rough(0.5f, 1), 400))},
      {"film over glass", filmed(roughGlass(false), 300, 1.8f)},
      {"rough sheet that absorbs", absorbing(thin(roughGlass(true)), vec3(0.2f, 1, 3))},
      {"sheet that lets light pass diffusely, too",
       absorbing(thin(translucent(roughGlass(true), 0.5f)), vec3(0.2f, 1, 3))},
      {"all, coated",
       thin(coated(sheened(stretched(filmed(translucent(rough(0.5f, 0.3f), 0.4f), 500), 0.6f), blue, 0.4f), 0.3f))}};
}

TEST_F(LayersTest, SampledDirectionsHaveTheStatedDensity) {
  for (const Case& c : layered()) {
    SCOPED_TRACE(c.name);
    expectDensity(c, outgoing()[2]);
  }
}

TEST_F(LayersTest, WeightsAreTheValueOverTheDensity) {
  for (const Case& c : layered()) expectWeights(c);
}

TEST_F(LayersTest, ReflectionIsReciprocal) {
  std::mt19937 random(3);
  for (const Case& c : layered())
    if (c.material.transmission == 0) expectReciprocal(c, random);
}

// Through a sheet light goes as much there as back. Photons into a solid scatter as paths from the eye do out of it.
TEST_F(LayersTest, TransmissionIsReciprocal) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> side(-1, 1), height(0.05f, 1);
  for (const Case& c : layered()) {
    const bool passes = c.material.transmission > 0 || c.material.diffuseTransmission > 0;
    if (!passes || c.material.coat > 0) continue;
    const bool isSolid = c.material.isSolid != 0;
    std::vector<Query> there(2000, c.material), back;
    for (Query& q : there) {
      q.wo = glm::normalize(vec3(side(random), side(random), height(random)));
      q.wi = glm::normalize(vec3(side(random), side(random), -height(random)));
      back.push_back(q);
      back.back().isAdjoint = 1;
      back.back().isFront = isSolid ? 1 - q.isFront : q.isFront;
      back.back().stretch.y *= -1;  // of the mirrored frame
      back.back().wo = vec3(q.wi.x, -q.wi.y, -q.wi.z);
      back.back().wi = vec3(q.wo.x, -q.wo.y, -q.wo.z);
    }
    const auto a = ask(there), b = ask(back);
    const double eta = c.material.isFront != 0 ? 1.5 : 1 / 1.5, square = isSolid ? eta * eta : 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const double f = static_cast<double>(a[i].value[channel] / -there[i].wi.z) / square;
        const double g = static_cast<double>(b[i].value[channel] / there[i].wo.z);
        ASSERT_NEAR(f, g, 1e-3 * std::max(f, g) + 1e-5) << c.name;  // rounding near total reflection
      }
    }
  }
}

// What is not reflected passes: a white surface stays white, whatever its share.
TEST_F(LayersTest, WhiteTranslucentSurfacesKeepTheirLight) {
  for (const float roughness : {0.0f, 0.4f, 1.0f}) {
    for (const float share : {0.3f, 1.0f}) {
      const Query sheet = thin(translucent(white(rough(roughness, 0)), share));
      for (const float cosine : {1.0f, 0.4f, 0.1f})
        EXPECT_TRUE(liesWithin(furnace(sheet, cosine), 1 - kTable, 1 + kTable)) << roughness << ' ' << share;
    }
  }
}

TEST_F(LayersTest, DiffuseTransmissionTakesItsShareAndHasItsColor) {
  Query sheet = thin(translucent(rough(1, 0), 0.75f, vec3(0.2f, 0.5f, 1)));
  sheet.specular = 0;
  for (int c = 0; c < 3; ++c) {
    test::Moments above, below;
    for (const Answer& a : sample(sheet, outgoing()[1], 16)) {
      above.add(a.isTransmission != 0 ? 0.0 : static_cast<double>(a.weight[c]));
      below.add(a.isTransmission != 0 ? static_cast<double>(a.weight[c]) : 0.0);
    }
    const double passed = 0.75 * static_cast<double>(sheet.diffuseTransmissionColor[c]);
    EXPECT_TRUE(liesWithin(above, 0.25 * 0.8 - 1e-3, 0.25 * 0.8 + 1e-3));
    EXPECT_TRUE(liesWithin(below, passed - 1e-3, passed + 1e-3));
  }
}

// What a sheet absorbs is missing, and no more; one that absorbs nothing is thin.
TEST_F(LayersTest, SheetsKeepWhatTheyDoNotAbsorb) {
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    Query clear = thin(white(rough(roughness, 0))), half = clear;
    clear.transmission = 1;
    half.transmission = 0.5f;
    for (const Query& sheet : {clear, half, translucent(half, 0.5f)}) {
      for (const float cosine : {1.0f, 0.5f, 0.1f}) {
        const vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
        const std::vector<test::Moments> light = furnaces(absorbing(sheet, vec3(0, 0.5f, 50)), wo);
        EXPECT_TRUE(liesWithin(light[0], 1 - kTable, 1 + kTable)) << roughness << ' ' << cosine;
        EXPECT_TRUE(liesWithin(light[1], 0, 0.98)) << roughness << ' ' << cosine;
        EXPECT_LT(light[2].mean(), light[1].mean()) << roughness << ' ' << cosine;
      }
    }
  }
}

// The base keeps what sheen leaves, so nothing is gained; with grey sheen little is lost.
TEST_F(LayersTest, SheenGainsNoEnergy) {
  for (const float sheenRoughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
    for (const float strength : {0.3f, 1.0f}) {
      const Query base = thin(white(rough(0.5f, 0))), metal = thin(white(rough(0.3f, 1)));
      for (const Query& under : {base, metal, translucent(base, 0.5f), coated(base, 0.3f), roughGlass(true)}) {
        for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f, 0.05f}) {
          const test::Moments light = furnace(sheened(under, vec3(strength), sheenRoughness), cosine);
          EXPECT_TRUE(liesWithin(light, 0.8 - 0.45 * static_cast<double>(strength), 1 + kCoatTable))
              << sheenRoughness << ' ' << strength << " cosine " << cosine;
        }
      }
    }
  }
}

/// Sheen alone, over black.
TEST_F(LayersTest, SheenReflectsItsTabulatedAlbedo) {
  // Charlie's lobe with the fitted masking, integrated over 800 x 800 directions.
  struct Known {
    float roughness, cosine;
    double albedo;
  };
  for (const Known& known : {Known{0.5f, 0.4f, 0.2761}, Known{0.5f, 0.05f, 0.7663}, Known{1, 1, 0.0902},
                             Known{1, 0.2f, 0.2309}, Known{0.3f, 0.2f, 0.6332}, Known{0.3f, 0.7f, 0.0513}}) {
    Query black = sheened(rough(1, 0), vec3(1), known.roughness);
    black.baseColor = vec3(0);
    black.specular = 0;
    EXPECT_TRUE(liesWithin(furnace(black, known.cosine), known.albedo - 0.004, known.albedo + 0.004))
        << known.roughness << ' ' << known.cosine;
  }
}

/// What interpolation in the table of stretched lobes may be off by; near the horizon more.
constexpr double kStretchTable = 0.012, kGrazingStretchTable = 0.03;

TEST_F(LayersTest, WhiteStretchedSurfacesKeepTheirLight) {
  for (const float roughness : {0.1f, 0.3f, 0.5f, 0.8f}) {
    for (const float strength : {0.2f, 0.5f, 0.8f, 1.0f}) {
      for (const float metallic : {0.0f, 1.0f}) {
        const Query surface = thin(stretched(white(rough(roughness, metallic)), strength));
        for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f, 0.05f}) {
          for (const float azimuth : {0.0f, 0.8f, 1.5f}) {
            const float sine = std::sqrt(1 - cosine * cosine);
            const vec3 wo(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
            const double table = cosine < 0.2f ? kGrazingStretchTable : kStretchTable;
            EXPECT_TRUE(liesWithin(furnaces(surface, wo)[0], 1 - table, 1 + table))
                << roughness << ' ' << strength << " metallic " << metallic << " cosine " << cosine << " azimuth "
                << azimuth;
          }
        }
      }
    }
  }
}

TEST_F(LayersTest, AnisotropyOfStrengthZeroChangesNothing) {
  for (const float metallic : {0.0f, 1.0f}) {
    std::vector<Query> plain(1, rough(0.4f, metallic)), turned(1, stretched(rough(0.4f, metallic), 0, 1));
    plain[0].wo = turned[0].wo = outgoing()[1];
    plain[0].wi = turned[0].wi = outgoing()[2];
    EXPECT_FLOAT_EQ(ask(plain)[0].value.x, ask(turned)[0].value.x);
  }
}

/// Highlights are long along the tangent's roughness: more light that leaves to the mirror's side of the tangent.
TEST_F(LayersTest, StretchedHighlightsAreWideAlongTheTangent) {
  Query across = stretched(rough(0.3f, 1), 0.8f), along = across;
  across.wo = along.wo = vec3(0, 0, 1);
  across.wi = glm::normalize(vec3(0, 0.6f, 0.8f));
  along.wi = glm::normalize(vec3(0.6f, 0, 0.8f));
  const auto answers = ask({along, across});
  EXPECT_GT(answers[0].value.x, 10 * answers[1].value.x);  // across there is light that was scattered more than once
}

// Films share out light in colours, and make none.
TEST_F(LayersTest, FilmsGainNoEnergy) {
  for (const float roughness : {0.0f, 0.2f, 0.6f, 1.0f}) {
    for (const float thickness : {150.0f, 400.0f}) {
      for (const float ior : {1.3f, 2.0f}) {
        const Query base = thin(filmed(white(rough(roughness, 0)), thickness, ior));
        Query metal = base, sheet = base, half = base;
        metal.metallic = 1;
        sheet.transmission = 1;
        half.metallic = half.iridescence = 0.5f;
        for (const Query& surface : {base, metal, sheet, half, solid(sheet, true), solid(sheet, false)}) {
          for (const float cosine : {1.0f, 0.6f, 0.2f, 0.05f}) {
            for (const test::Moments& light : furnaces(surface, vec3(std::sqrt(1 - cosine * cosine), 0, cosine)))
              EXPECT_TRUE(liesWithin(light, 0, 1 + kCoatTable))
                  << "roughness " << roughness << " thickness " << thickness << " ior " << ior << " cosine " << cosine
                  << " metallic " << surface.metallic << " transmission " << surface.transmission;
          }
        }
      }
    }
  }
}

/// Without thickness, or of the index of air, the film is not there.
TEST_F(LayersTest, FilmsWithoutThicknessShowTheBase) {
  for (const float cosine : {1.0f, 0.5f, 0.2f}) {
    Query mirror = rough(0, 1);
    mirror.baseColor = vec3(0.9f, 0.5f, 0.1f);
    mirror.wo = vec3(std::sqrt(1 - cosine * cosine), 0, cosine);
    const auto answers = ask({mirror, filmed(mirror, 0), filmed(mirror, 400, 1)});
    EXPECT_EQ(answers[0].weight, answers[1].weight);
    EXPECT_EQ(answers[0].weight, answers[2].weight);
  }
}

TEST_F(LayersTest, FilmsHaveTheColorsOfTheirThickness) {
  Query film = rough(0, 0);
  film.baseColor = vec3(0);
  const auto reflected = [&](float thickness) { return ask({filmed(film, thickness, 1.33f)})[0].weight; };
  // Quarter-wave on glass of a higher index: least reflection where 4 n d is the wavelength, at 550 nm green.
  Query glass = film;
  glass.ior = 1.8f;
  const vec3 quarter = ask({filmed(glass, 550 / (4 * 1.33f), 1.33f)})[0].weight;
  const double bare = std::pow(0.8 / 2.8, 2);
  EXPECT_LT(quarter.y, 0.2 * bare);
  EXPECT_LT(quarter.y, quarter.z);
  const vec3 thin = reflected(150), thick = reflected(300);
  EXPECT_GT(std::abs(thin.x / thin.z - thick.x / thick.z), 0.2f);
}

}  // namespace
}  // namespace importon::bsdf_test::layers_test
