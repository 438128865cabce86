// Required density by path differentials, against footprints in closed form: seen directly, in a mirror, and by what
// a patch scatters.
#include <gtest/gtest.h>

#include <cmath>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon::importance_bound_test {
namespace {

using glm::dvec3;
using test::SceneBuilder;

constexpr double kFov = 0.6;
constexpr int kSide = 32;  // pixels

RenderJob boundJob(DifferentialBound bound, std::uint32_t importons = 1u << 15) {
  RenderJob job;
  job.passes = 1;
  job.photons = 64;
  job.importons = importons;
  job.maxDepth = 4;
  job.importance = ImportanceChoice::differentials;
  job.differentialBound = bound;
  return job;
}

/// Pixels/m² of a camera at z = `eye` that looks along z, at a point of a plane across its axis.
double perSquareMetre(const dvec3& p, double eye) {
  const double h = std::abs(p.z - eye), d2 = p.x * p.x + p.y * p.y + h * h, cosine = h / std::sqrt(d2);
  const double perSteradian = kSide * kSide / (4 * std::pow(std::tan(0.5 * kFov), 2)) / std::pow(cosine, 3);
  return perSteradian * cosine / d2;
}

class ImportanceBound : public test::GpuTest {
 protected:
  /// Bound over expectation at the importons where there is one.
  template <class Expected>
  test::Moments ratios(const SceneBuilder& builder, const RenderJob& job, MapKind kind, Expected expected) const {
    const Scene scene = builder.finish();
    test::MapRig rig(context(), scene, job);
    rig.findImportance();
    const test::ImportonsFound found = rig.importons(kind);
    const std::vector<float> bounds = (kind == MapKind::caustic ? rig.importance.caustic : rig.importance.global)
                                          .bound.download<float>(found.points.size());
    test::Moments ratios;
    for (std::size_t i = 0; i < found.points.size(); ++i)
      if (const double e = expected(dvec3(found.points[i].position) + scene.worldFromRender); e > 0)
        ratios.add(static_cast<double>(bounds[i]) / e);
    return ratios;
  }
};

/// A camera at z = 1 looks into a mirror at z = -2 that shows the wall at z = 3.
SceneBuilder mirrorScene(float reflectance) {
  SceneBuilder builder;
  builder.square(builder.material(test::mirror(vec3(reflectance))), {0, 0, -2}, {0, 0, 1}, 4);
  builder.square(builder.material(test::diffuse(vec3(0.7f))), {0, 0, 3}, {0, 0, -1}, 20);
  builder.pointLight({0, 0, 1}, vec3(1));
  builder.camera({0, 0, 1}, {0, 0, -2}, kFov, kSide, kSide);
  return builder;
}

double seenInTheMirror(const dvec3& p) {
  const double edge = 0.9 * 8 * std::tan(0.5 * kFov);  // of what the mirror shows of the wall
  return p.z > 2.9 && std::max(std::abs(p.x), std::abs(p.y)) < edge ? perSquareMetre(p, -5) : 0;
}

/// Neighbours over which the maximum goes differ by up to 2 % where the camera's field is 0.6 wide.
TEST_F(ImportanceBound, OfPixelsIsOneFootprintInAMirrorTimesItsReflectance) {
  const test::Moments r =
      ratios(mirrorScene(0.5f), boundJob(DifferentialBound::pixel), MapKind::caustic, seenInTheMirror);
  ASSERT_GT(r.count(), 1'000);
  EXPECT_GT(r.mean(), 0.5);
  EXPECT_LT(r.mean(), 0.51);
  EXPECT_LT(std::sqrt(r.variance()), 0.01) << "footprints have no noise";
}

/// The sum is a density estimate of importons, by kernels as large as sixteen of them take: on average within 3 % of
/// importance, of which its own noise, 25 % / sqrt(1000), allows four deviations.
TEST_F(ImportanceBound, OfTheScreenIsImportance) {
  const test::Moments r =
      ratios(mirrorScene(1), boundJob(DifferentialBound::screen), MapKind::caustic, seenInTheMirror);
  ASSERT_GT(r.count(), 1'000);
  EXPECT_NEAR(r.mean(), 1, 0.03);
  EXPECT_LT(std::sqrt(r.variance()), 0.25);
}

/// On a wall across the axis at the distance h a pixel covers s x s, and the steps to the neighbours on the lens, of
/// which n cover it, b x b with b = R sqrt(π/n) |1 - h/M|; covariances add up.
TEST_F(ImportanceBound, OfALensCoversItsDiscToo) {
  constexpr double kHeight = 3, kFocus = 1, kSamples = 4;
  SceneBuilder builder;
  builder.square(builder.material(test::diffuse(vec3(0.7f))), {0, 0, 1 - kHeight}, {0, 0, 1}, 20);
  builder.square(builder.material(test::mirror()), {0, 0, 3}, {0, 0, 1}, 0.1);  // out of sight: a caustic map
  builder.pointLight({0, 0, 1}, vec3(1));
  builder.camera({0, 0, 1}, {0, 0, -2}, kFov, kSide, kSide);
  RenderJob job = boundJob(DifferentialBound::pixel, 1u << 13);
  job.gather = static_cast<int>(kSamples);
  job.fStop = 0.5;
  job.focus = kFocus;
  const double slope = std::tan(0.5 * kFov), pixel = 2 * slope * kHeight / kSide;
  const double step = 0.012 / slope * std::sqrt(M_PI / kSamples) * std::abs(1 - kHeight / kFocus);
  const test::Moments r = ratios(builder, job, MapKind::caustic,
                                 [&](const dvec3& p) { return p.z < 0 ? 1 / (pixel * pixel + step * step) : 0.0; });
  ASSERT_GT(r.count(), 1'000);
  EXPECT_NEAR(r.mean(), 1, 0.01);
  EXPECT_LT(std::sqrt(r.variance()), 0.01) << "footprints have no noise";
}

/// The camera sees a small patch alone; the wall opposite is met by gather rays of it. Each of the n that a pixel has
/// in a pass covers 1/(n p) sr, so a place at the distance d is asked for n · albedo · cosθ cosθ' / (π d²) pixels/m².
TEST_F(ImportanceBound, OfAGatherRayIsTheSolidAngleThatItCovers) {
  constexpr double kAlbedo = 0.6, kHeight = 1.5, kSamples = 16;
  SceneBuilder builder;
  const uint material = builder.material(test::diffuse(vec3(static_cast<float>(kAlbedo))));
  builder.square(material, {0, 0, 0}, {0, 1, 0}, 0.02);
  builder.square(material, {0, kHeight, 0}, {0, -1, 0}, 6);
  builder.pointLight({0, 1, 0}, vec3(1));
  builder.camera({0, 0.5, 0}, {0, 0, 0}, 0.02, 16, 16, {0, 0, -1});
  RenderJob job = boundJob(DifferentialBound::pixel, 1u << 16);
  job.gather = static_cast<int>(kSamples);
  const test::Moments r = ratios(builder, job, MapKind::global, [&](const dvec3& p) {
    const double d2 = glm::dot(p, p), cosine = kHeight / std::sqrt(d2);
    return p.y > 1 && std::hypot(p.x, p.z) < 1.5 ? kSamples * kAlbedo * cosine * cosine / (M_PI * d2) : 0.0;
  });
  ASSERT_GT(r.count(), 3'000);
  EXPECT_GT(r.mean(), 0.98);
  EXPECT_LT(r.mean(), 1.1);
}

}  // namespace
}  // namespace importon::importance_bound_test
