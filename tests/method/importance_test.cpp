// Importance maps against importance in closed form. Importons start uniformly over the image, so seen directly
// Γ = N_pix / (4 w h) · cosθ / (d² cos³α) pixels/m², with w and h half the image's extent at distance 1, d the
// distance, θ the angle at the surface and α the angle off the camera's axis.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "method/map_rig.h"
#include "method/render_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon::importance_test {
namespace {

using glm::dvec3;
using test::SceneBuilder;

struct View {
  dvec3 position, target;
  double yfov;
  int width, height;
};

/// Γ in pixels/m² of a camera at a point with `normal` that it sees directly.
double seenDirectly(const View& view, const dvec3& point, const dvec3& normal) {
  const dvec3 to = point - view.position;
  const double d = glm::length(to), cosAxis = glm::dot(to / d, glm::normalize(view.target - view.position));
  const double h = std::tan(0.5 * view.yfov), w = h * view.width / view.height;
  const double perSteradian = view.width * view.height / (4 * w * h) / std::pow(cosAxis, 3);
  return perSteradian * std::abs(glm::dot(to / d, normal)) / (d * d);
}

RenderJob importonJob(std::uint32_t importons, uint seed) {
  RenderJob job;
  job.passes = 1;
  job.photons = 64;
  job.importons = importons;
  job.seed = seed;
  job.maxDepth = 4;
  job.forcesAllFeatures = true;  // a caustic map in any scene
  job.aovs = {"importance.caustic", "importance.global", "P"};
  return job;
}

void addCamera(SceneBuilder& builder, const View& view) {
  builder.camera(view.position, view.target, view.yfov, view.width, view.height);
}

/// Ratio of the caustic importance at the pixels to `expected(position)`, over seeds; edge pixels left out.
template <class Expected>
test::Moments ratios(const Scene& scene, const View& view, std::uint32_t importons, int seeds, Expected expected,
                     const std::optional<Crop>& crop = {}) {
  test::Moments moments;
  const int width = crop ? crop->width : view.width, height = crop ? crop->height : view.height;
  for (int seed = 0; seed < seeds; ++seed) {
    RenderJob job = importonJob(importons, static_cast<uint>(seed));
    job.crop = crop;
    job.forcesAllFeatures = !crop;  // the scene of a crop has a mirror
    const RenderResult result = test::renderScene(scene, job);
    const auto &gamma = test::channel(result, "importance.caustic.Y"), &x = test::channel(result, "P.X"),
               &y = test::channel(result, "P.Y"), &z = test::channel(result, "P.Z");
    for (int row = 1; row + 1 < height; ++row) {
      for (int column = 1; column + 1 < width; ++column) {
        const auto i = static_cast<std::size_t>(row * width + column);
        moments.add(static_cast<double>(gamma[i]) / expected(dvec3(x[i], y[i], z[i])));
      }
    }
  }
  return moments;
}

/// No bias of M/(M-1), which is 1.032 here. From M importons at random places the estimate (M-1)/(π r²) has the
/// mean 1; importons come from a low-discrepancy sequence, and from evenly spread ones it has at least
/// (M-1)/(M-1/2), since the outermost one counts half. Significance: 1e-4.
void expectUnbiased(const test::Moments& ratios) {
  constexpr double kNearest = 32, kFourDeviations = 3.9;
  const double slack = kFourDeviations * ratios.standardError();
  EXPECT_GT(ratios.mean(), (kNearest - 1) / (kNearest - 0.5) - slack);
  EXPECT_LT(ratios.mean(), 1 + slack);
  EXPECT_LT(ratios.standardError(), 0.003) << "the test would not see the bias";
  EXPECT_LT(std::sqrt(ratios.variance()), 1 / std::sqrt(kNearest - 2)) << "estimates are worse than random ones";
}

class Importance : public test::GpuTest {};

TEST_F(Importance, OfAPlaneSeenDirectlyIsThePixelsPerSquareMetre) {
  const View view{{0, 1.5, 2}, {0, 0, 0}, 0.8, 32, 32};
  SceneBuilder builder;
  builder.quad(builder.material(test::diffuse(vec3(0.7f))), {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
  builder.directionalLight({0, -1, 0}, vec3(1));
  addCamera(builder, view);
  expectUnbiased(ratios(builder.finish(), view, 1u << 16, 1, [&](const dvec3& p) {
    return seenDirectly(view, p, {0, 1, 0});
  }));
}

TEST_F(Importance, OfACropIsThatOfItsPixelsAndNoneBesides) {
  const View view{{0, 1.5, 2}, {0, 0, 0}, 0.8, 32, 32};
  SceneBuilder builder;
  builder.quad(builder.material(test::diffuse(vec3(0.7f))), {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
  builder.square(builder.material(test::mirror()), {0, 3, 8}, {0, 0, -1}, 0.1);  // out of sight: a caustic map
  builder.directionalLight({0, -1, 0}, vec3(1));
  addCamera(builder, view);
  const Scene scene = builder.finish();
  const Crop crop{4, 2, 26, 29};
  const auto expected = [&](const dvec3& p) { return seenDirectly(view, p, {0, 1, 0}); };
  expectUnbiased(ratios(scene, view, 1u << 16, 1, expected, crop));
  RenderJob job = importonJob(1u << 12, 0);
  job.crop = crop;
  job.forcesAllFeatures = false;
  test::MapRig rig(context(), scene, job);
  rig.findImportance();
  const test::ImportonsFound found = rig.importons(MapKind::caustic);
  ASSERT_FALSE(found.points.empty());
  const Parameters& p = rig.parameters;
  for (const MapPoint& point : found.points) {
    const vec3 to = point.position - p.cameraOrigin, seen = to / glm::dot(to, p.cameraForward);
    const double column = 16 * (1 + glm::dot(seen, p.cameraRight) / glm::dot(p.cameraRight, p.cameraRight));
    const double row = 16 * (1 - glm::dot(seen, p.cameraUp) / glm::dot(p.cameraUp, p.cameraUp));
    EXPECT_TRUE(column > crop.x - 0.01 && column < crop.x + crop.width + 0.01) << column;
    EXPECT_TRUE(row > crop.y - 0.01 && row < crop.y + crop.height + 0.01) << row;
  }
}

TEST_F(Importance, OfAPlaneSeenAtAGrazingAngleFollowsTheFootprint) {
  const View view{{0, 0.4, 3}, {0, 0, 0}, 0.2, 32, 32};
  SceneBuilder builder;
  builder.quad(builder.material(test::diffuse(vec3(0.7f))), {-40, 0, 40}, {80, 0, 0}, {0, 0, -80});
  builder.directionalLight({0, -1, 0}, vec3(1));
  addCamera(builder, view);
  expectUnbiased(ratios(builder.finish(), view, 1u << 16, 1, [&](const dvec3& p) {
    return seenDirectly(view, p, {0, 1, 0});
  }));
}

/// The camera looks into a mirror at z = -2 that shows the wall at z = 3 behind the camera.
class MirrorScene {
 public:
  explicit MirrorScene(float reflectance) {
    const uint wall = builder_.material(test::diffuse(vec3(0.7f)));
    builder_.square(builder_.material(test::mirror(vec3(reflectance))), {0, 0, -2}, {0, 0, 1}, 4);
    builder_.square(wall, {0, 0, 3}, {0, 0, -1}, 20);
    builder_.pointLight({0, 0, 1}, vec3(1));
    addCamera(builder_, view_);
  }
  [[nodiscard]] Scene scene() const { return builder_.finish(); }
  [[nodiscard]] const View& view() const { return view_; }

 private:
  View view_{{0, 0, 1}, {0, 0, -2}, 0.6, 64, 64};
  SceneBuilder builder_;
};

/// Γ on the wall: that of the camera mirrored at the plane z = -2, which looks towards +z from z = -5.
double seenInTheMirror(const View& view, const dvec3& p) {
  View mirrored = view;
  mirrored.position = {0, 0, -5};
  mirrored.target = {0, 0, 0};
  return seenDirectly(mirrored, p, {0, 0, -1});
}

test::Moments ratiosInTheMirror(gpu::Context& context, float reflectance) {
  const MirrorScene mirror(reflectance);
  const Scene scene = mirror.scene();
  test::MapRig rig(context, scene, importonJob(1u << 16, 3));
  rig.findImportance();
  const test::ImportonsFound found = rig.importons(MapKind::caustic);
  test::Moments ratios;
  const double edge = 0.9 * 8 * std::tan(0.3);  // of what the mirror shows of the wall
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const dvec3 p = dvec3(found.points[i].position) + scene.worldFromRender;
    if (std::max(std::abs(p.x), std::abs(p.y)) > edge || p.z < 2.9) continue;
    ratios.add(static_cast<double>(found.importance[i]) / seenInTheMirror(mirror.view(), p));
  }
  return ratios;
}

TEST_F(Importance, PassesThroughAMirror) {
  const test::Moments ratios = ratiosInTheMirror(context(), 1);
  ASSERT_GT(ratios.count(), 3'000);
  expectUnbiased(ratios);
}

TEST_F(Importance, IsLostAtAMirrorInProportionToItsReflectance) {
  const double full = ratiosInTheMirror(context(), 1).mean();
  EXPECT_NEAR(ratiosInTheMirror(context(), 0.5f).mean() / full, 0.5, 0.01);
}

TEST_F(Importance, OfAWallLitByWhatTheCameraSeesIsThePatchsFormFactor) {
  // The camera sees nothing but a small patch; the wall opposite gets what the patch scatters:
  // Γ = N_pix · albedo · cosθ cosθ' / (π d²).
  const View view{{0, 0.5, 0}, {0, 0, 0}, 0.02, 16, 16};
  constexpr double kAlbedo = 0.6, kHeight = 1.5;
  SceneBuilder builder;
  const uint material = builder.material(test::diffuse(vec3(static_cast<float>(kAlbedo))));
  builder.square(material, {0, 0, 0}, {0, 1, 0}, 0.02);
  builder.square(material, {0, kHeight, 0}, {0, -1, 0}, 6);
  builder.pointLight({0, 1, 0}, vec3(1));
  builder.camera(view.position, view.target, view.yfov, view.width, view.height, {0, 0, -1});
  const Scene scene = builder.finish();
  test::MapRig rig(context(), scene, importonJob(1u << 17, 1));
  rig.findImportance();
  const test::ImportonsFound found = rig.importons(MapKind::global);
  test::Moments ratios;
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const dvec3 p = dvec3(found.points[i].position) + scene.worldFromRender;
    if (p.y < 1 || std::hypot(p.x, p.z) > 2) continue;
    const double d2 = glm::dot(p, p), cosine = kHeight / std::sqrt(d2);
    const double expected = view.width * view.height * kAlbedo * cosine * cosine / (M_PI * d2);
    ratios.add(static_cast<double>(found.importance[i]) / expected);
  }
  ASSERT_GT(ratios.count(), 3'000);
  expectUnbiased(ratios);
}

}  // namespace
}  // namespace importon::importance_test
