// Direct light in closed form.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"
#include "scene/lights.h"
#include "support/profile_lamp.h"

namespace importon::test::irradiance_test {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kSize = 24;

class Irradiance : public RenderTest, public ::testing::WithParamInterface<Integrator> {
 protected:
  [[nodiscard]] Rendered renderDirect(const Scene& scene, int passes = 4) const {
    return renderScene(makeJob(GetParam(), passes), scene);
  }
};

/// A white plane at y = 0 (80 m wide), seen from the side.
SceneBuilder whitePlane(double yfov = 1.0, const glm::dvec3& target = {0.2, 0, 0.1}) {
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 80);
  builder.camera({0, 3, 3}, target, yfov, kSize, kSize);
  return builder;
}

/// Image of the plane, on which a white surface has the radiance E / π.
std::vector<double> imageOf(const Scene& scene, const std::function<double(const glm::dvec3&)>& irradiance) {
  return planeImage(scene, {0, 0, 0}, {0, 1, 0}, [&](const glm::dvec3& p) { return irradiance(p) / kPi; });
}

/// Irradiance at `point` from a polygon of radiance 1, counter-clockwise seen from the lit side.
/// [Lambert 1760; Arvo 1995, eq. 5]
double polygonIrradiance(const glm::dvec3& point, const glm::dvec3& normal, const std::vector<glm::dvec3>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(corners[i] - point);
    const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - point);
    sum += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
  }
  return std::abs(sum) / 2;
}

std::vector<glm::dvec3> discCorners(const glm::dvec3& center, const glm::dvec3& normal, double radius, int segments) {
  glm::dvec3 tangent, bitangent;
  tangentFrame(normal, tangent, bitangent);
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * kPi * i / segments;
    corners.push_back(center + radius * (std::cos(angle) * tangent + std::sin(angle) * bitangent));
  }
  return corners;
}

TEST_P(Irradiance, OfPointLightFallsWithTheCubeOfTheCosine) {
  const StabilityCase listed(5, "point light over a plane", "E = I cos³ / h²");
  constexpr double kHeight = 1.5;
  SceneBuilder builder = whitePlane();
  builder.pointLight({0, kHeight, 0}, vec3(5.0f));
  const Scene scene = builder.finish();
  EXPECT_TRUE(isImageOf(renderDirect(scene).image, imageOf(scene, [](const glm::dvec3& p) {
                          const double cosine = kHeight / std::sqrt(kHeight * kHeight + p.x * p.x + p.z * p.z);
                          return 5 * cosine * cosine * cosine / (kHeight * kHeight);
                        })));
}

TEST_P(Irradiance, OfDirectionalLightGoesWithTheCosine) {
  SceneBuilder builder = whitePlane();
  builder.directionalLight({0.6, -0.8, 0}, vec3(3.0f));
  EXPECT_TRUE(isConstant(renderDirect(builder.finish()).image, 3 * 0.8 / kPi, 1e-6));  // float rounding
}

TEST_P(Irradiance, OfSpotLightFollowsKhrLightsPunctual) {
  constexpr double kInner = 0.2, kOuter = 0.6, kHeight = 2;
  SceneBuilder builder = whitePlane(0.2, {0.4, 0, 0});
  builder.spotLight({0, kHeight, 0}, {0, -1, 0}, vec3(5.0f), kInner, kOuter);
  const Scene scene = builder.finish();
  EXPECT_TRUE(isImageOf(renderDirect(scene, 16).image, imageOf(scene, [](const glm::dvec3& p) {
                          const double d2 = kHeight * kHeight + p.x * p.x + p.z * p.z, cosine = kHeight / std::sqrt(d2);
                          const double t =
                              std::clamp((cosine - std::cos(kOuter)) / (std::cos(kInner) - std::cos(kOuter)), 0.0, 1.0);
                          return 5 * t * t * cosine / d2;
                        })));
}

/// A lamp whose light goes with both angles, not along the axes of the world, as it is and mirrored.
TEST_P(Irradiance, OfALampWithAProfileFollowsTheProfile) {
  const IesProfile profile(Photometry::typeC, {0, 30, 90}, {0, 90, 180, 270, 360},
                           {5, 8, 1, 5, 2, 1, 5, 4, 1, 5, 9, 1, 5, 8, 1});
  const LightProfile sampled = sampleProfile(profile);
  for (const bool isMirrored : {false, true}) {
    SceneBuilder builder = whitePlane(0.6, {0.4, 0, 0});
    builder.pointLight({0.1, 2, 0}, vec3(1));
    Scene scene = builder.finish();
    Light& light = test::shineByProfile(scene, sampled, vec3(glm::normalize(glm::dvec3(0.2, -1, 0.1))));
    light.area = 0.7f;
    light.isTwoSided = isMirrored ? 1 : 0;
    // The frame of shaders/lib/sampling.glsl, turned by the lamp's angle.
    const glm::dvec3 axis(light.direction);
    const double s = axis.z >= 0 ? 1 : -1, a = -1 / (s + axis.z), b = axis.x * axis.y * a;
    const glm::dvec3 u(1 + s * axis.x * axis.x * a, s * b, -s * axis.x), v(b, s + axis.y * axis.y * a, -axis.y);
    const glm::dvec3 x = std::cos(0.7) * u + std::sin(0.7) * v;
    const glm::dvec3 y = glm::cross(x, axis) * (isMirrored ? -1.0 : 1.0);
    EXPECT_TRUE(isImageOf(
        renderDirect(scene, 16).image,
        imageOf(scene,
                [&](const glm::dvec3& p) {
                  const glm::dvec3 to = p - glm::dvec3(0.1, 2, 0), w = glm::normalize(to);
                  const double intensity = profile.intensity({glm::dot(w, x), glm::dot(w, y), -glm::dot(w, axis)});
                  return intensity * -w.y / glm::dot(to, to);
                })))
        << isMirrored;
  }
}

TEST_P(Irradiance, OfNarrowSpotLightIsItsIntensityOnTheAxis) {
  SceneBuilder builder = whitePlane(1e-4);
  builder.spotLight({0.2, 2, 0.1}, {0, -1, 0}, vec3(5.0f), 0.0, 0.01);
  // Beside the axis by up to 0.3 mm of 2 m: the cosine is short of 1 by 1e-8, of the 5e-5 of the cone.
  EXPECT_TRUE(isConstant(renderDirect(builder.finish()).image, 5.0 / 4 / kPi, 2e-3));
}

/// In its cone a spot light is chosen as often as a point light that brings as much, so that either choice gives the
/// same light.
TEST_P(Irradiance, OfSpotAndPointLightAlikeHasNoNoise) {
  SceneBuilder builder = whitePlane(1e-4, {0, 0, 0});
  builder.pointLight({1, 2, 0}, vec3(5.0f));
  builder.spotLight({-1, 2, 0}, {1 / std::sqrt(5.0), -2 / std::sqrt(5.0), 0}, vec3(5.0f), 0.05, 0.1);
  const double expected = 2 * 5 * (2 / std::sqrt(5.0)) / 5 / kPi;
  EXPECT_TRUE(isConstant(renderDirect(builder.finish(), 2).image, expected, 1e-3));  // 0.3 mm beside the middle
}

TEST_P(Irradiance, OfDiscLightOnItsAxis) {
  const StabilityCase listed(6, "disc light on its axis", "E = pi L R² / (R² + h²)");
  constexpr double kHeight = 1.5, kRadius = 0.8;
  for (const int segments : {48, 128}) {  // lights weighed one by one; lights chosen by power
    SceneBuilder builder = whitePlane(0.01);
    builder.disc(builder.material(emitter(vec3(2.0f))), {0.2, kHeight, 0.1}, {0, -1, 0}, kRadius, segments);
    const Scene scene = builder.finish();
    const auto corners = discCorners({0.2, kHeight, 0.1}, {0, -1, 0}, kRadius, segments);
    const double closedForm = 2 * kPi * kRadius * kRadius / (kRadius * kRadius + kHeight * kHeight);
    EXPECT_NEAR(2 * polygonIrradiance({0.2, 0, 0.1}, {0, 1, 0}, corners), closedForm,
                closedForm * 10 / (segments * segments));
    EXPECT_TRUE(isImageOf(renderDirect(scene, 8).image, imageOf(scene,
                                                                [&](const glm::dvec3& p) {
                                                                  return 2 * polygonIrradiance(p, {0, 1, 0}, corners);
                                                                })))
        << segments;
  }
}

/// Case 20: light and camera nearly along the plane, a tenth of a degree over it.
TEST_P(Irradiance, OfGrazingLightSeenGrazinglyGoesWithTheCosine) {
  const StabilityCase listed(20, "light and camera a tenth of a degree over the plane", "E cos");
  const double cosine = std::sin(0.1 * kPi / 180), sine = std::sqrt(1 - cosine * cosine);
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 80);
  builder.directionalLight({sine, -cosine, 0}, vec3(1000.0f));
  builder.camera({0, 10 * cosine, 10 * sine}, {0, 0, 0}, 1e-4, kSize, kSize);
  // Float rounding of the light's direction: 6e-8 of its cosine of 1.7e-3.
  EXPECT_TRUE(isConstant(renderDirect(builder.finish(), 1).image, 1000 * cosine / kPi, 2e-4));
}

/// Case 42: a light of 1e-12 m² is a point, over which its cosine to the plane comes in twice.
TEST_P(Irradiance, OfTinyAreaLightIsThatOfAPoint) {
  const StabilityCase listed(42, "a light of 1e-12 m²", "that of a point");
  constexpr double kHeight = 1.5, kArea = 1e-12, kRadiance = 1e12;
  SceneBuilder builder = whitePlane();
  builder.square(builder.material(emitter(vec3(static_cast<float>(kRadiance)))), {0, kHeight, 0}, {0, -1, 0},
                 std::sqrt(kArea));
  const Scene scene = builder.finish();
  EXPECT_TRUE(isImageOf(renderDirect(scene, 2).image, imageOf(scene, [](const glm::dvec3& p) {
                          const double d2 = kHeight * kHeight + p.x * p.x + p.z * p.z;
                          return kRadiance * kArea * kHeight * kHeight / (d2 * d2);
                        })));
}

/// A shadow ray ends at the light.
TEST_P(Irradiance, IsNotShadowedByWhatStandsBehindTheLight) {
  constexpr double kHeight = 1.5, kArea = 1e-6, kRadiance = 1e6;
  SceneBuilder builder = whitePlane(0.2);
  builder.square(builder.material(emitter(vec3(static_cast<float>(kRadiance)))), {0, kHeight, 0}, {0, -1, 0},
                 std::sqrt(kArea));
  builder.square(builder.material(diffuse(vec3(0.0f))), {0, 1.1 * kHeight, 0}, {0, -1, 0}, 1);
  const Scene scene = builder.finish();
  EXPECT_TRUE(isImageOf(renderDirect(scene, 2).image, imageOf(scene, [](const glm::dvec3& p) {
                          const double d2 = kHeight * kHeight + p.x * p.x + p.z * p.z;
                          return kRadiance * kArea * kHeight * kHeight / (d2 * d2);
                        })));
}

TEST_P(Irradiance, OfUniformEnvironmentIsPiTimesItsRadiance) {
  SceneBuilder builder = whitePlane();
  builder.environment(vec3(0.7f));
  EXPECT_TRUE(isImageOf(renderDirect(builder.finish()).image, std::vector<double>(kSize * kSize, 0.7)));
}

/// A dim sky with a bright spot above, left of -z.
EnvironmentMap skyWithSun() {
  EnvironmentMap map{16, 8, {}};
  for (int i = 0; i < 16 * 8; ++i) map.texels.emplace_back(0.1f + 0.05f * static_cast<float>(i % 3));
  map.texels[16 + 5] = vec3(20.0f);
  return map;
}

/// W/m² on a horizontal surface from a map that is interpolated as documented, by 8 x 8 points a texel.
double irradianceFromAbove(const EnvironmentMap& map) {
  constexpr int kPoints = 8;
  const int width = map.width * kPoints, height = map.height * kPoints;
  const auto texel = [&](int x, int y) {
    const int column = (x + map.width) % map.width, row = std::clamp(y, 0, map.height - 1);
    return static_cast<double>(map.texels[static_cast<std::size_t>(row * map.width + column)].x);
  };
  double sum = 0;
  for (int j = 0; j < height / 2; ++j) {
    const double top = std::cos(kPi * j / height), bottom = std::cos(kPi * (j + 1) / height);
    const double y = (j + 0.5) / kPoints - 0.5, fy = y - std::floor(y);
    for (int i = 0; i < width; ++i) {
      const double x = (i + 0.5) / kPoints - 0.5, fx = x - std::floor(x);
      const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
      const double radiance = (1 - fy) * ((1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0)) +
                              fy * ((1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1));
      sum += radiance * kPi / width * (top * top - bottom * bottom);  // cosine times solid angle
    }
  }
  return sum;
}

TEST_P(Irradiance, OfEnvironmentMapIsItsIntegral) {
  SceneBuilder builder = whitePlane();
  builder.environment(skyWithSun());
  const double expected = irradianceFromAbove(skyWithSun()) / kPi;
  EXPECT_TRUE(isImageOf(renderDirect(builder.finish(), 16).image, std::vector<double>(kSize * kSize, expected)));
}

TEST_P(Irradiance, BesideLargeLightIsThatOfThePolygon) {
  SceneBuilder builder = whitePlane(0.15, {0.2, 0, 1.6});
  builder.quad(builder.material(emitter(vec3(2.0f))), {-1, 0.1, -1}, {2, 0, 0}, {0, 0, 2});  // facing down
  const Scene scene = builder.finish();
  const std::vector<glm::dvec3> corners = {{-1, 0.1, -1}, {1, 0.1, -1}, {1, 0.1, 1}, {-1, 0.1, 1}};
  EXPECT_TRUE(isImageOf(renderDirect(scene, 16).image, imageOf(scene, [&](const glm::dvec3& p) {
                          return 2 * polygonIrradiance(p, {0, 1, 0}, corners);
                        })));
}

INSTANTIATE_TEST_SUITE_P(Both, Irradiance, ::testing::Values(Integrator::path, Integrator::photon),
                         [](const auto& test) { return test.param == Integrator::path ? "Path" : "Photon"; });

}  // namespace
}  // namespace importon::test::irradiance_test
