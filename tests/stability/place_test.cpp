// Where a scene stands, how it is turned and how it is cut into triangles must not matter.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "render_helper.h"

namespace importon::test::place_test {
namespace {

constexpr int kSize = 16;

class Place : public RenderTest {};

/// A box with a ball in it, lit from inside.
SceneBuilder room() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.icosphere(builder.material(diffuse(vec3(0.3f))), {0.3, -0.5, -0.2}, 0.35, 2, Facing::outside,
                    Shading::smooth);
  builder.square(builder.material(emitter(vec3(3.0f))), {0, 0.9, 0}, {0, -1, 0}, 0.6);
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, kSize, kSize);
  return builder;
}

std::vector<double> meansOfSeeds(RenderJob job, const Scene& scene, std::uint32_t seeds) {
  std::vector<double> means;
  for (job.seed = 1; job.seed <= seeds; ++job.seed) means.push_back(meanOf(renderScene(job, scene).image));
  return means;
}

/// Seed by seed: the noise is the same, too.
TEST_F(Place, FarFromTheOriginTheImageIsTheSame) {
  const StabilityCase listed(9, "scene 1e5 of its sizes from the origin", "the image within what positions allow");
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    SceneBuilder far = room();
    far.transform(glm::translate(glm::dmat4(1.0), {2e5, -1e5, 3e5}));
    const RenderJob job = makeJob(integrator, 1);
    EXPECT_TRUE(isWithin(0.02, ratiosOf(meansOfSeeds(job, far.finish(), 4), meansOfSeeds(job, room().finish(), 4)), 1));
  }
}

TEST_F(Place, FarFromTheOriginNoLightLeaksIntoAClosedBox) {
  const StabilityCase listed(9, "closed box 1e5 of its sizes from the origin, light outside", "0 inside");
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.8f))), {-1, -1, -1}, {1, 1, 1}, Facing::outside, 8);
  builder.pointLight({3, 0.5, 0.2}, vec3(10.0f));
  builder.camera({0.1, 0.2, 0.3}, {-0.1, -0.3, -1}, 2.0, kSize, kSize);
  builder.transform(glm::translate(glm::dmat4(1.0), {2e5, -1e5, 3e5}));
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Image image = renderScene(makeJob(integrator, 4), builder.finish()).image;
    EXPECT_TRUE(isSane(image));
    for (const float value : valuesOf(image)) ASSERT_EQ(value, 0.0f);
  }
}

TEST_F(Place, RotationChangesNothingInTheMean) {
  const StabilityCase listed(10, "the scene rotated", "the same mean");
  RenderJob job = makeJob(Integrator::photon, 2);
  job.gather = 32;
  job.photons = 1u << 14;
  const Moments upright = meanOverSeeds(job, room().finish(), 10);
  for (const double angle : {0.7, 2.1}) {
    SceneBuilder turned = room();
    turned.transform(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(glm::dvec3(1, 2, -0.5))));
    EXPECT_TRUE(areWithin(0.02, meanOverSeeds(job, turned.finish(), 10), upright)) << angle;
  }
}

TEST_F(Place, SlowNeedlesMakeAPlane) {
  const StabilityCase listed(11, "a plane as 1e6 needles of aspect 1e6", "the irradiance of a plane");
  SceneBuilder builder;
  builder.quad(builder.material(diffuse(vec3(0.8f))), {-2, 0, 4}, {4, 0, 0}, {0, 0, -8}, 500'000, 1);
  builder.pointLight({0, 1, 0}, vec3(2.0f));
  builder.camera({0, 1.5, 0.01}, {0, 0, 0}, 0.8, kSize, kSize);
  const Scene scene = builder.finish();
  const auto radiance = [](const glm::dvec3& x) {
    const double square = x.x * x.x + x.z * x.z + 1;
    return 0.8 / glm::pi<double>() * 2 / (square * std::sqrt(square));
  };
  const std::vector<double> expected = planeImage(scene, {0, 0, 0}, {0, 1, 0}, radiance);
  for (const Integrator integrator : {Integrator::path, Integrator::photon})
    EXPECT_TRUE(isImageOf(renderScene(makeJob(integrator, 4), scene).image, expected));
}

/// Boxes tell little of needles that lie diagonally: a ray meets a good part of them, more than lavapipe lets it.
TEST_F(Place, SlowRaysAmongTooManyDiagonalNeedlesAreGivenUpWithACount) {
  StabilityCase listed(60, "400,000 needles at 45 degrees to the axes", "a warning, with the number of rays given up");
  SceneBuilder builder;
  builder.quad(builder.material(diffuse(vec3(0.8f))), {-2, 0, 4}, {4, 0, 0}, {0, 0, -8}, 200'000, 1);
  builder.pointLight({0, 1, 0}, vec3(2.0f));
  builder.camera({0, 1.5, 0.01}, {0, 0, 0}, 0.8, 4, 4);
  builder.transform(glm::rotate(glm::dmat4(1.0), glm::quarter_pi<double>(), glm::dvec3(0, 1, 0)));
  const Rendered r = renderScene(makeJob(Integrator::path, 1), builder.finish());
  EXPECT_TRUE(isSane(r.image));
  const auto given =
      std::find_if(r.warnings.begin(), r.warnings.end(), [](const Warning& w) { return w.kind == "rays given up"; });
  ASSERT_TRUE(given != r.warnings.end());
  EXPECT_GT(std::stoul(given->message), 0u) << given->message;
  listed.note(given->message, 0.99);
}

/// Every point of a glowing sphere lies over the horizon of the plane that it touches.
TEST_F(Place, SphereLightThatTouchesAPlaneHasItsMean) {
  const StabilityCase listed(38, "a sphere light that touches a plane", "E = pi L r² h / d³");
  constexpr double kRadius = 0.3;
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 4);
  builder.icosphere(builder.material(emitter(vec3(2.0f))), {0, kRadius, 0}, kRadius, 6, Facing::outside, Shading::flat);
  builder.camera({1, 1, 0}, {0.5, 0, 0}, 0.5, kSize, kSize);
  const Scene scene = builder.finish();
  const auto radiance = [](const glm::dvec3& x) {
    const double distance = std::sqrt(x.x * x.x + x.z * x.z + kRadius * kRadius);
    return 2 * kRadius * kRadius * kRadius / (distance * distance * distance);
  };
  const std::vector<double> expected = planeImage(scene, {0, 0, 0}, {0, 1, 0}, radiance);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Image image = renderScene(makeJob(integrator, 8), scene).image;
    EXPECT_TRUE(isSane(image));
    EXPECT_TRUE(isImageOf(image, expected, 2));
  }
}

}  // namespace
}  // namespace importon::test::place_test
