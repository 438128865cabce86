// Lights that are weak, many, hidden, huge, tiny, or where they should not be.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "hard_scenes.h"
#include "render_helper.h"

namespace importon::test::light_test {
namespace {

constexpr int kSize = 12;
constexpr double kPi = glm::pi<double>();

class HardLights : public RenderTest {};

double areaOf(const Scene& scene, std::size_t first, std::size_t count) {
  double area = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const Triangle& t = scene.triangles[i];
    area += 0.5 * glm::length(glm::cross(glm::dvec3(scene.positions[t.v1] - scene.positions[t.v0]),
                                         glm::dvec3(scene.positions[t.v2] - scene.positions[t.v0])));
  }
  return area;
}

TEST_F(HardLights, SlowWeakLightGetsPhotonsBesideAStrongHiddenOne) {
  const StabilityCase listed(45, "photons of a light 1e-8 as strong as a hidden one",
                             "E = power / (4 pi R² (1 - albedo))");
  const Scene scene = sphereBesideStrongLight(kSize);
  const double expected = 0.5 / kPi * 4 * kPi / (areaOf(scene, 0, scene.triangles.size() / 2) * 0.5);
  for (const EmissionChoice emission : {EmissionChoice::power, EmissionChoice::guided}) {
    RenderJob job = makeJob(Integrator::photon, 2);
    job.emission = emission;
    job.maxDepth = 24;
    EXPECT_TRUE(hasMean(meanOverSeeds(job, scene, 8), expected, 2));
  }
}

TEST_F(HardLights, ImagesScaleExactlyByPowersOfTwoOfTheLight) {
  const StabilityCase listed(46, "light times 2^-60 and 2^60", "the image times the same, bit for bit");
  const auto imageOf = [](float scale, Integrator integrator) {
    SceneBuilder builder;
    builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
    builder.square(builder.material(emitter(vec3(scale))), {0, 0.9, 0}, {0, -1, 0}, 0.6);
    builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
    return renderScene(makeJob(integrator, 1), builder.finish()).image;
  };
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Image plain = imageOf(1, integrator);
    for (const int exponent : {-60, 60}) {
      Image scaled = imageOf(std::ldexp(1.0f, exponent), integrator);
      for (Channel& channel : scaled.channels)
        for (float& value : channel.values) value = std::ldexp(value, -exponent);
      EXPECT_TRUE(haveSameBits(plain, scaled)) << exponent;
    }
  }
}

/// Point lights on a surface, in a corner and inside glass, and an emitter in the plane of the floor.
TEST_F(HardLights, StandWhereTheyShouldNot) {
  const StabilityCase listed(47, "lights on surfaces, in corners, in planes, in glass", "finite");
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.icosphere(builder.material(glass(1.5f)), {0.4, 0, 0}, 0.2, 2, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(vec3(1.0f), true)), {0, -1, 0}, {0, 1, 0}, 0.5);
  for (const glm::dvec3 place : {glm::dvec3(0, 1, 0), {1, 1, 1}, {-1, 0, 0}, {0.4, 0, 0}, {0.6, 0, 0}})
    builder.pointLight(place, vec3(1.0f));
  builder.spotLight({0, 1, 0}, {0, 1, 0}, vec3(1.0f), 0, 0.5);
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Rendered r = renderScene(makeJob(integrator, 2), builder.finish());
    EXPECT_TRUE(isSane(r.image));
    EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits);
  }
}

/// A grid of points of seven intensities.
TEST_F(HardLights, SlowTenThousandPointsLightAPlane) {
  const StabilityCase listed(59, "10,000 point lights over a plane", "E = sum of I cos³ / h²");
  constexpr int kSide = 100;
  constexpr double kHeight = 0.2, kSpacing = 0.04;
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 6);
  std::vector<std::pair<glm::dvec2, double>> lights;
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::dvec2 place = kSpacing * (glm::dvec2(i % kSide, i / kSide) - 0.5 * (kSide - 1));
    lights.emplace_back(place, 1e-3 * (1 + i % 7));
    builder.pointLight({place.x, kHeight, place.y}, vec3(static_cast<float>(lights.back().second)));
  }
  builder.camera({0, 3, 0.01}, {0, 0, 0}, 0.8, 6, 6);
  const Scene scene = builder.finish();
  const auto radiance = [&](const glm::dvec3& x) {
    double sum = 0;
    for (const auto& [place, intensity] : lights) {
      const double square = std::pow(x.x - place.x, 2) + std::pow(x.z - place.y, 2) + kHeight * kHeight;
      sum += intensity * kHeight / (square * std::sqrt(square));
    }
    return sum / kPi;
  };
  const std::vector<double> expected = planeImage(scene, {0, 0, 0}, {0, 1, 0}, radiance);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    RenderJob job = makeJob(integrator, 8);
    job.gather = 32;
    EXPECT_TRUE(isImageOf(renderScene(job, scene).image, expected, 2));
  }
}

/// A square light of a million triangles against one of two.
TEST_F(HardLights, SlowMillionTrianglesShineLikeTwo) {
  const StabilityCase listed(42, "a million light-emitting triangles", "the light of two");
  const auto meansOf = [](int cells, Integrator integrator) {
    SceneBuilder builder;
    builder.square(builder.material(diffuse(vec3(0.8f))), {0, 0, 0}, {0, 1, 0}, 4);
    builder.square(builder.material(emitter(vec3(1.0f))), {0, 1, 0}, {0, -1, 0}, 1, cells);
    builder.camera({0, 0.8, 1.5}, {0, 0, 0}, 0.8, kSize, kSize);
    return meanOverSeeds(makeJob(integrator, 2), builder.finish(), 8);
  };
  for (const Integrator integrator : {Integrator::path, Integrator::photon})
    EXPECT_TRUE(haveSameMean(meansOf(1, integrator), meansOf(708, integrator), 2));
}

/// Walls of A glow with radiance 1; a slit lets light into B.
TEST_F(HardLights, SlowSlitFillsTheRoomBehindIt) {
  const StabilityCase listed(24, "a 1 mm slit between two rooms", "power behind it pi L A_slit / (1 - albedo)");
  constexpr double kSlit = 1e-3, kAlbedo = 0.5, kGap = 1e-6;  // m; the gap keeps the rooms' walls apart
  SceneBuilder builder;
  const uint glowing = builder.material(emitter(vec3(1.0f))),
             grey = builder.material(diffuse(vec3(static_cast<float>(kAlbedo))));
  // Each wall between the rooms is two parts, above and below the slit.
  for (const double side : {-1.0, 1.0}) {
    const uint material = side < 0 ? glowing : grey;
    builder.quad(material, {side * kGap, -1, side}, {0, 0, -2 * side}, {0, 1 - kSlit / 2, 0});
    builder.quad(material, {side * kGap, kSlit / 2, side}, {0, 0, -2 * side}, {0, 1 - kSlit / 2, 0});
    builder.square(material, {2 * side, 0, 0}, {-side, 0, 0}, 2);
    for (const double s : {-1.0, 1.0}) {
      builder.square(material, {side, s, 0}, {0, -s, 0}, 2);
      builder.square(material, {side, 0, s}, {0, 0, -s}, 2);
    }
  }
  builder.camera({1.8, 0.5, 0.5}, {0.5, -0.2, -0.2}, 1.2, kSize, kSize);
  const Scene scene = builder.finish();
  for (const EmissionChoice emission : {EmissionChoice::power, EmissionChoice::guided}) {
    RenderJob job = makeJob(Integrator::photon, 1);
    job.photons = 1u << 18;
    job.importons = 1u << 14;
    job.emission = emission;
    job.maxDepth = 24;
    const auto power = [](const Rendered& r) { return std::vector{r.stats.global.fluxHits[0]}; };
    EXPECT_TRUE(hasMean(overSeeds(job, scene, 10, power).front(), kPi * 2 * kSlit / (1 - kAlbedo), 2));
  }
}

}  // namespace
}  // namespace importon::test::light_test
