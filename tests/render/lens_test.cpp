// A thin lens: a point out of focus becomes an evenly lit disc of a size in closed form; what is in focus is what a
// pinhole shows.
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "render/plan/camera_setup.h"
#include "render_helper.h"

namespace importon::test::lens_test {
namespace {

constexpr int kSize = 40;
constexpr double kYfov = 0.1;

class Lens : public RenderTest {};

/// A square emitter of radiance 1, seen face to face.
Scene smallLamp(double distance, double side) {
  SceneBuilder builder;
  builder.square(builder.material(emitter(vec3(1))), {0, 0, -distance}, {0, 0, 1}, side);
  builder.camera({0, 0, 0}, {0, 0, -1}, kYfov, kSize, kSize);
  return builder.finish();
}

double pixelsPerUnit() { return kSize / (2 * std::tan(kYfov / 2)); }  // of the image at distance 1

/// A point at distance z is a disc of radius R |1/z - 1/M| of the image at distance 1, for a lens of radius R that has
/// the distance M in focus; here of 12 pixels. The lamp of 6 x 6 pixels moves over it as a whole, so a pixel's light is
/// the share of the disc from which it is on the lamp: 36 of its pixels where all of the lamp is within it.
TEST_F(Lens, APointOutOfFocusIsAnEvenDiscOfTheRightSize) {
  constexpr double kNear = 2, kFocus = 4, kSide = 6;  // m, m, pixels
  const Scene scene = smallLamp(kNear, kSide * kNear / pixelsPerUnit());
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 384;
  job.fStop = 1;
  job.focus = kFocus;
  const double lens = 0.012 / std::tan(kYfov / 2) / 2;
  const double radius = lens * (1 / kNear - 1 / kFocus) * pixelsPerUnit(), area = std::numbers::pi * radius * radius;
  ASSERT_GT(radius, 11);
  ASSERT_LT(radius, 13);
  const std::vector<Moments> found = overSeeds(job, scene, 8, [&](const Rendered& rendered) {
    constexpr double kDiagonals = 5;  // at least half those of lamp and pixel
    double sum = 0, squares = 0, beyond = 0;
    Moments inner, outer;
    for (int i = 0; i < kSize * kSize; ++i) {
      const int column = i % kSize, row = i / kSize;
      const double r = std::hypot(column + 0.5 - kSize / 2.0, row + 0.5 - kSize / 2.0);
      const auto value = static_cast<double>(rendered.image.find("R")->values[static_cast<std::size_t>(i)]);
      sum += value;
      squares += value * r * r;
      if (r < 4)
        inner.add(value);
      else if (r < radius - kDiagonals)
        outer.add(value);
      if (r > radius + kDiagonals) beyond += value;
    }
    // Of a disc's points r² is radius²/2 in the mean, of a square's side²/6; within a pixel all are at its middle.
    const double diameter = 2 * std::sqrt(2 * (squares / sum + 1 / 6.0 - kSide * kSide / 6));
    return std::vector{sum, diameter, inner.mean(), outer.mean(), beyond};
  });
  EXPECT_TRUE(isWithin(0.01, found[0], kSide * kSide)) << "no light is lost";
  EXPECT_TRUE(isWithin(0.01, found[1], 2 * radius));
  EXPECT_TRUE(isWithin(0.04, found[2], kSide * kSide / area));
  EXPECT_TRUE(isWithin(0.04, found[3], kSide * kSide / area));
  EXPECT_EQ(found[4].mean(), 0);
}

/// A wall with lamps on it at 3 m, and in front of it, at the side, a box; lit by a lamp behind the camera, too.
Scene stage() {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.7f, 0.6f, 0.5f)));
  builder.quad(white, {-2, -1, -3}, {4, 0, 0}, {0, 2, 0}, 4, 4);
  builder.quad(white, {-2, -0.7, 1}, {4, 0, 0}, {0, 0, -4});
  for (const double x : {-0.7, -0.2, 0.5})
    builder.square(builder.material(emitter(vec3(3))), {x, 0.2, -2.99}, {0, 0, 1}, 0.2);
  builder.box(builder.material(diffuse(vec3(0.2f, 0.5f, 0.8f))), {0.1, -0.7, -1.8}, {0.5, -0.2, -1.4}, Facing::outside);
  builder.icosphere(builder.material(mirror(vec3(0.9f))), {-0.5, -0.4, -1.6}, 0.25, 2, Facing::outside,
                    Shading::smooth);
  builder.square(builder.material(emitter(vec3(20))), {0, 1.5, 0.5}, {0, -1, -0.5}, 0.5);
  builder.camera({0, 0, 0}, {0, -0.05, -1}, 0.7, 32, 32);
  return builder.finish();
}

/// Mean difference of the pixels over their mean.
double differenceOf(const Image& a, const Image& b) {
  double sum = 0, difference = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float> va = valuesOf(a, channel), vb = valuesOf(b, channel);
    for (std::size_t i = 0; i < va.size(); ++i) {
      sum += static_cast<double>(vb[i]);
      difference += std::abs(static_cast<double>(va[i] - vb[i]));
    }
  }
  return difference / sum;
}

/// The same random numbers lead to the same points of what is in focus, but for rounding at edges.
TEST_F(Lens, WhatIsInFocusIsThatOfAPinhole) {
  SceneBuilder builder;
  const uint wall = builder.material(diffuse(vec3(0.6f)));
  builder.quad(wall, {-2, -2, -3}, {4, 0, 0}, {0, 4, 0});
  for (const double x : {-0.7, 0.1, 0.6})
    builder.square(builder.material(emitter(vec3(2))), {x, 0.3, -3 + 1e-4}, {0, 0, 1}, 0.3);
  builder.pointLight({0.3, 0.5, 1}, vec3(9));
  builder.camera({0, 0, 0}, {0, 0, -1}, 0.6, 32, 32);
  const Scene scene = builder.finish();
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 64;
  job.maxDepth = 1;
  const Image pinhole = renderScene(job, scene).image;
  job.fStop = 0.5;
  job.focus = 3;
  EXPECT_LT(differenceOf(renderScene(job, scene).image, pinhole), 0.005);
  job.focus = 1;
  EXPECT_GT(differenceOf(renderScene(job, scene).image, pinhole), 0.1) << "the test sees what is out of focus";
}

TEST_F(Lens, AGreatStopTendsToThePinhole) {
  const Scene scene = stage();
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 64;
  const Image pinhole = renderScene(job, scene).image;
  job.focus = 1;
  std::vector<double> differences;
  for (const double fStop : {0.2, 20.0, 2e6}) {
    job.fStop = fStop;
    differences.push_back(differenceOf(renderScene(job, scene).image, pinhole));
  }
  EXPECT_GT(differences[0], 2 * differences[1]);
  EXPECT_LT(differences[2], 0.01);
}

/// Means of the left and right halves over seeds.
std::vector<Moments> halvesOf(RenderJob job, const Scene& scene, int seeds) {
  job.fStop = 0.2;
  job.focus = 1.5;
  return overSeeds(job, scene, seeds, [](const Rendered& r) {
    return std::vector{meanOf(r.image, Region{0, 0, 16, 32}), meanOf(r.image, Region{16, 0, 32, 32})};
  });
}

std::vector<Moments> halvesByPaths(const Scene& scene) {
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 256;
  return halvesOf(job, scene, 8);
}

RenderJob photonJob() {
  RenderJob job = makeJob(Integrator::photon, 2);
  job.gather = 16;
  return job;
}

/// Light shared among pixels, too. Significance 0.01 that each half is within 3 %.
TEST_F(Lens, ThePhotonMapShowsWhatPathsFind) {
  const Scene scene = stage();
  RenderJob job = photonJob();
  job.sharesLight = true;
  const std::vector<Moments> reference = halvesByPaths(scene), found = halvesOf(job, scene, 8);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(areWithin(0.03, found[i], reference[i])) << i;
}

/// Significance 0.01 that each half is within 2 %.
TEST_F(Lens, InOtherWaysShowsWhatPathsFind) {
  const Scene scene = stage();
  const std::vector<Moments> reference = halvesByPaths(scene);
  for (const ImportanceChoice importance : {ImportanceChoice::map, ImportanceChoice::differentials}) {
    RenderJob job = photonJob();
    job.passes = 4;
    job.importance = importance;
    const std::vector<Moments> found = halvesOf(job, scene, 12);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(areWithin(0.02, found[i], reference[i])) << i;
  }
}

TEST(ChooseLens, TakesTheJobsAndElseTheCameras) {
  Camera camera;
  RenderJob job;
  EXPECT_TRUE(chooseLens(camera, job).isPinhole());
  camera.yfov = 2 * std::atan(0.24);  // 50 mm
  camera.focusDistance = 3;
  EXPECT_TRUE(chooseLens(camera, job).isPinhole());
  job.fStop = 2;
  EXPECT_NEAR(chooseLens(camera, job).radius, 0.0125, 1e-12);
  EXPECT_EQ(chooseLens(camera, job).focusDistance, 3);
  job.focus = 5;
  EXPECT_EQ(chooseLens(camera, job).focusDistance, 5);
  camera.fStop = 4;
  EXPECT_NEAR(chooseLens(camera, job).radius, 0.0125, 1e-12);
  job.fStop.reset();
  EXPECT_NEAR(chooseLens(camera, job).radius, 0.00625, 1e-12);
}

TEST(ChooseLens, RefusesWhatIsNone) {
  Camera camera;
  camera.yfov = 2 * std::atan(0.24);
  RenderJob job;
  job.fStop = 2;
  EXPECT_THROW((void)chooseLens(camera, job), UsageError) << "without a distance";
  job.focus = 0.05;
  EXPECT_THROW((void)chooseLens(camera, job), UsageError) << "in the focal length";
  job.focus = 0.051;
  EXPECT_FALSE(chooseLens(camera, job).isPinhole());
  camera.isOrthographic = true;
  EXPECT_THROW((void)chooseLens(camera, job), UsageError);
  camera.isOrthographic = false;
  job.fStop.reset();
  EXPECT_THROW((void)chooseLens(camera, job), UsageError) << "without a stop";
}

}  // namespace
}  // namespace importon::test::lens_test
