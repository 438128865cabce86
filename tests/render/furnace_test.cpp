// Closed rooms whose walls glow: L = Le / (1 - albedo) everywhere.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::furnace_test {
namespace {

constexpr int kSize = 32;

class Furnace : public RenderTest {};

SceneBuilder lookingInto(const glm::dvec3& eye) {
  SceneBuilder builder;
  builder.camera(eye, {-0.3, -0.2, -1}, 1.6, kSize, kSize);
  return builder;
}

Scene glowingBox(float albedo) {
  SceneBuilder builder = lookingInto({0.2, 0.1, 0.7});
  const uint walls = builder.material(emitter(vec3(1.0f), false, vec3(albedo)));
  builder.box(walls, {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  return builder.finish();
}

Scene glowingSphere(float albedo) {
  SceneBuilder builder = lookingInto({0.2, 0.1, 0.6});
  const uint walls = builder.material(emitter(vec3(1.0f), false, vec3(albedo)));
  builder.icosphere(walls, {0, 0, 0}, 1, 2, Facing::inside, Shading::flat);
  return builder.finish();
}

double radianceOf(float albedo) { return 1 / (1 - static_cast<double>(albedo)); }

/// So deep that what is cut off is below a millionth.
RenderJob deepJob(Integrator integrator, int passes, float albedo) {
  RenderJob job = makeJob(integrator, passes);
  job.maxDepth = albedo > 0.6f ? 62 : 20;
  return job;
}

TEST_F(Furnace, PathTracedBoxIsUniform) {
  const StabilityCase listed(1, "closed glowing box, by paths", "L = Le / (1 - albedo)");
  for (const float albedo : {0.5f, 0.8f}) {
    const Rendered r = renderScene(deepJob(Integrator::path, 8, albedo), glowingBox(albedo));
    EXPECT_TRUE(isImageOf(r.image, std::vector<double>(kSize * kSize, radianceOf(albedo)), 4)) << albedo;
  }
}

TEST_F(Furnace, PathTracedSphereIsUniform) {
  const StabilityCase listed(1, "closed glowing sphere, by paths", "L = Le / (1 - albedo)");
  for (const float albedo : {0.5f, 0.8f}) {
    const Rendered r = renderScene(deepJob(Integrator::path, 8, albedo), glowingSphere(albedo));
    EXPECT_TRUE(isImageOf(r.image, std::vector<double>(kSize * kSize, radianceOf(albedo)), 4)) << albedo;
  }
}

/// Case 2: what is cut off is the rest of the series, albedo^(depth + 1) of all.
TEST_F(Furnace, DepthCapLosesTheRestOfTheSeries) {
  const StabilityCase listed(2, "albedo 0.999 with a cap on depth", "short of it by albedo^depth");
  constexpr double kAlbedo = 0.999;
  RenderJob job = makeJob(Integrator::path, 1);
  for (const int depth : {1, 5, 30}) {
    job.maxDepth = depth;
    job.gather = 16;
    const Image image = renderScene(job, glowingBox(static_cast<float>(kAlbedo))).image;
    const double expected = (1 - std::pow(kAlbedo, depth + 1)) / (1 - kAlbedo);
    EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(image)), expected)) << depth;
  }
}

TEST_F(Furnace, PhotonMappedSphereIsUniform) {
  const StabilityCase listed(1, "closed glowing sphere, by photons", "L = Le / (1 - albedo)");
  for (const float albedo : {0.5f, 0.8f}) {
    const Moments means = meanOverSeeds(deepJob(Integrator::photon, 2, albedo), glowingSphere(albedo), 8);
    EXPECT_TRUE(isWithin(0.01, means, radianceOf(albedo))) << albedo;
  }
}

/// Cells know their area, so no light is lost at edges: neither in the whole view nor where it looks into a corner.
TEST_F(Furnace, PhotonMappedBoxIsUniformUpToItsCorners) {
  const StabilityCase listed(1, "closed glowing box, by photons", "L = Le / (1 - albedo)");
  constexpr float kAlbedo = 0.8f;
  SceneBuilder builder;
  builder.camera({0.3, 0.3, 0.3}, {-1, -1, -1}, 0.5, kSize, kSize);
  const uint walls = builder.material(emitter(vec3(1.0f), false, vec3(kAlbedo)));
  builder.box(walls, {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  RenderJob job = deepJob(Integrator::photon, 2, kAlbedo);
  job.photons = 1u << 15;
  EXPECT_TRUE(isWithin(0.005, meanOverSeeds(job, glowingBox(kAlbedo), 8), radianceOf(kAlbedo)));
  EXPECT_TRUE(isWithin(0.005, meanOverSeeds(job, builder.finish(), 8), radianceOf(kAlbedo))) << "in a corner";
}

/// The kernel of a lookup loses the share of its disc that lies beyond an edge of the wall, so the mean is too
/// low by a share that goes with the radius, and twice the mean at half the radius less the mean at the radius
/// is free of it: 2 within 2 %, by two one-sided tests at a significance of 0.01, whose power is 0.97.
TEST_F(Furnace, PhotonMappedBoxIsUniformAsTheRadiusVanishes) {
  RenderJob job = deepJob(Integrator::photon, 1, 0.5f);
  job.control = DensityControl::off;
  job.gatherFrom = GatherSource::photons;
  const Scene scene = glowingBox(0.5f);
  const auto meansAtRadius = [&](double radius) {
    job.constantDensity = 32 / (glm::pi<double>() * radius * radius);
    return meanOverSeeds(job, scene, 8);
  };
  const Moments wide = meansAtRadius(0.08), narrow = meansAtRadius(0.04);
  const double extrapolated = 2 * narrow.mean() - wide.mean();
  const double error = std::hypot(2 * narrow.standardError(), wide.standardError());
  constexpr double kMargin = 0.04, kPoint = 2.33;  // normal, at a significance of 0.01
  EXPECT_LT(std::abs(extrapolated - 2) + kPoint * error, kMargin) << extrapolated << " +- " << error;
  EXPECT_LT(wide.mean(), narrow.mean());
}

}  // namespace
}  // namespace importon::test::furnace_test
