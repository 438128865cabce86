// lib/differential.glsl and lib/sampled_spread.glsl: footprints against closed forms, against paths moved by finite
// steps, and against the density of sampling.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "accel/bvh.h"
#include "render/device_scene/device_scene.h"
#include "shared/render_data.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "test_kernels/differential_chain.h"
#include "test_kernels/sampled_spread.h"
#include "test_kernels/spread.h"

namespace importon {
namespace {

using glm::dvec3;
using test::SceneBuilder;

/// Runs a test kernel that reads items and writes as many results, with the scene.
template <class Call, class Result, class Item>
std::vector<Result> runOnScene(gpu::Context& context, const Scene& scene, const std::vector<Item>& items) {
  const DeviceScene deviceScene = uploadScene(context, scene, buildBvh(scene.positions, scene.triangles));
  const gpu::Kernel kernel(context, "kernel under test", Call::kCode);
  const gpu::Buffer input = gpu::makeBuffer(context, "items", std::span<const Item>(items));
  const gpu::Buffer output(context, "results", items.size() * sizeof(Result));
  gpu::Recorder recorder(context);
  recorder.dispatch(kernel,
                    Call::buffers(deviceScene, test_kernels::buffers::In{input}, test_kernels::buffers::Out{output}),
                    items.size(), static_cast<uint>(items.size()));
  recorder.submitAndWait();
  return output.download<Result>(items.size());
}

Scene triangleOf(const Material& definition) {
  SceneBuilder builder;
  builder.triangle(builder.material(definition), {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  builder.directionalLight({0, -1, 0}, vec3(1));
  return builder.finish();
}

/// As in tests/kernels/spread.comp.
struct Step {
  uint kind;
  float t, eta;
  Spread spread;
  vec3 direction, normal, slope;
};
enum StepKind : uint { kTransfer, kReflect, kRefract };

/// A ray with what its differential was at the start; the axis is z.
struct Path {
  dvec3 origin{0}, direction;
  Spread x, y;
};

/// Spreads of paths that start at the origin at several angles to the axis, taken through surfaces step by step: the
/// ray on the host, its spreads on the device.
class Differential : public test::GpuTest {
 protected:
  void start(const std::vector<double>& angles) {
    paths_.clear();
    for (const double angle : angles)
      paths_.push_back({dvec3(0),
                        {std::sin(angle), 0, std::cos(angle)},
                        {vec3(0), {std::cos(angle), 0, -std::sin(angle)}, 0},
                        {vec3(0), {0, 1, 0}, 0}});
  }
  void toPlane(double z) {
    step(kTransfer, 1, [z](const Path& p) { return Event{(z - p.origin.z) / p.direction.z, {0, 0, 1}, 0}; });
  }
  /// To the sphere's near side, or to its far one from inside.
  void toSphere(double centre, double radius, bool isInside) {
    step(kTransfer, 1, [=](const Path& p) {
      const dvec3 to = dvec3(0, 0, centre) - p.origin;
      const double b = glm::dot(to, p.direction), root = std::sqrt(radius * radius - glm::dot(to, to) + b * b);
      const double t = isInside ? b + root : b - root;
      return Event{t, normalAt(p.origin + t * p.direction, centre), 0};
    });
  }
  void atPlane(StepKind kind, double eta = 1) {
    step(kind, eta, [](const Path&) { return Event{0, {0, 0, -1}, 0}; });
  }
  void atSphere(StepKind kind, double centre, double radius, double eta = 1) {
    step(kind, eta, [=](const Path& p) { return Event{0, normalAt(p.origin, centre), 1 / radius}; });
  }
  /// `radius`: where on the last plane a path of an angle arrives, from the axis, with its derivative by the angle.
  void expectFootprints(const std::vector<double>& angles,
                        const std::function<std::pair<double, double>(double)>& radius) const {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const auto [rho, slope] = radius(angles[i]);
      const double tolerance = 2e-5 * (std::abs(slope) + std::abs(rho / std::sin(angles[i])));
      EXPECT_NEAR(paths_[i].origin.x, rho, 1e-9) << "the host's own path at angle " << angles[i];
      EXPECT_NEAR(static_cast<double>(paths_[i].x.position.x), slope, tolerance) << "angle " << angles[i];
      EXPECT_NEAR(static_cast<double>(paths_[i].y.position.y), rho / std::sin(angles[i]), tolerance)
          << "angle " << angles[i];
    }
  }

 private:
  struct Event {
    double t;
    dvec3 normal;
    double curvature;  // 1/m
  };
  static dvec3 normalAt(const dvec3& p, double centre) { return glm::normalize(p - dvec3(0, 0, centre)); }

  void step(StepKind kind, double eta, const std::function<Event(const Path&)>& eventOf) {
    std::vector<Step> steps;
    for (const Path& p : paths_) {
      const Event e = eventOf(p);
      const dvec3 normal = glm::dot(e.normal, p.direction) > 0 ? -e.normal : e.normal;
      const float curvature = static_cast<float>(glm::dot(e.normal, p.direction) > 0 ? -e.curvature : e.curvature);
      for (const Spread& s : {p.x, p.y})
        steps.push_back({kind, static_cast<float>(e.t), static_cast<float>(eta), s, vec3(p.direction), vec3(normal),
                         curvature * s.position});
    }
    const auto moved = runOnScene<test_kernels::Spread, Spread>(context(), scene_, steps);
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      Path& p = paths_[i];
      p.x = moved[2 * i];
      p.y = moved[2 * i + 1];
      const Event e = eventOf(p);
      const dvec3 normal = glm::dot(e.normal, p.direction) > 0 ? -e.normal : e.normal;
      p.origin += e.t * p.direction;
      if (kind == kReflect) p.direction = glm::reflect(p.direction, normal);
      if (kind == kRefract) p.direction = glm::refract(p.direction, normal, 1 / eta);
    }
  }

  Scene scene_ = triangleOf(test::diffuse(vec3(0.5f)));
  std::vector<Path> paths_;
};

const std::vector<double> kAngles{0.01, 0.05, 0.1, 0.17};

double square(double v) { return v * v; }

TEST_F(Differential, OnAPlaneIsThatOfPerspective) {
  const std::vector<double> angles{0.01, 0.3, 0.9, 1.4};
  start(angles);
  toPlane(2.5);
  expectFootprints(angles, [](double a) { return std::pair(2.5 * std::tan(a), 2.5 / square(std::cos(a))); });
}

TEST_F(Differential, AfterAFlatMirrorIsThatOfTheMirroredCamera) {
  const std::vector<double> angles{0.01, 0.3, 0.9, 1.4};
  start(angles);
  toPlane(2);
  atPlane(kReflect);
  toPlane(-1);
  expectFootprints(angles, [](double a) { return std::pair(5 * std::tan(a), 5 / square(std::cos(a))); });
}

TEST_F(Differential, AfterASphericalMirrorFollowsItsCurvature) {
  constexpr double kCentre = 4, kRadius = 1, kBack = 2;
  start(kAngles);
  toSphere(kCentre, kRadius, false);
  atSphere(kReflect, kCentre, kRadius);
  toPlane(-kBack);
  // With i the angle of incidence, the hit lies at i - a from the axis as seen from the centre, and the ray goes back
  // at 2i - a from it.
  expectFootprints(kAngles, [](double a) {
    const double i = std::asin(kCentre * std::sin(a) / kRadius),
                 iSlope = kCentre * std::cos(a) / (kRadius * std::cos(i));
    const double height = kCentre - kRadius * std::cos(i - a) + kBack, back = 2 * i - a;
    return std::pair(kRadius * std::sin(i - a) + height * std::tan(back),
                     kRadius * std::cos(i - a) * (iSlope - 1) +
                         kRadius * std::sin(i - a) * (iSlope - 1) * std::tan(back) +
                         height / square(std::cos(back)) * (2 * iSlope - 1));
  });
}

TEST_F(Differential, AfterAGlassSlabIsShortenedByItsIndex) {
  constexpr double kThick = 0.8, kFar = 3, kIndex = 1.5;
  const std::vector<double> angles{0.01, 0.3, 0.9, 1.4};
  start(angles);
  toPlane(1);
  atPlane(kRefract, kIndex);
  toPlane(1 + kThick);
  atPlane(kRefract, 1 / kIndex);
  toPlane(kFar);
  expectFootprints(angles, [](double a) {
    const double r = std::asin(std::sin(a) / kIndex), rSlope = std::cos(a) / (kIndex * std::cos(r));
    return std::pair((kFar - kThick) * std::tan(a) + kThick * std::tan(r),
                     (kFar - kThick) / square(std::cos(a)) + kThick / square(std::cos(r)) * rSlope);
  });
}

TEST_F(Differential, AfterAGlassBallIsThatOfTheLens) {
  constexpr double kCentre = 4, kRadius = 1, kFar = 6.5, kIndex = 1.5;
  start(kAngles);
  toSphere(kCentre, kRadius, false);
  atSphere(kRefract, kCentre, kRadius, kIndex);
  toSphere(kCentre, kRadius, true);
  atSphere(kRefract, kCentre, kRadius, 1 / kIndex);
  toPlane(kFar);
  // With r the angle inside, the ray leaves the ball at 2r - i + a from the axis as seen from the centre, and turns by
  // 2(i - r) towards the axis.
  expectFootprints(kAngles, [](double a) {
    const double i = std::asin(kCentre * std::sin(a) / kRadius),
                 iSlope = kCentre * std::cos(a) / (kRadius * std::cos(i));
    const double r = std::asin(std::sin(i) / kIndex), rSlope = std::cos(i) / (kIndex * std::cos(r)) * iSlope;
    const double leave = 2 * r - i + a, leaveSlope = 2 * rSlope - iSlope + 1, out = a - 2 * i + 2 * r;
    const double height = kFar - kCentre - kRadius * std::cos(leave);
    return std::pair(kRadius * std::sin(leave) + height * std::tan(out),
                     kRadius * std::cos(leave) * leaveSlope + kRadius * std::sin(leave) * leaveSlope * std::tan(out) +
                         height / square(std::cos(out)) * (1 - 2 * iSlope + 2 * rSlope));
  });
}

/// As in tests/kernels/differential_chain.comp.
struct ChainItem {
  vec3 origin;
  uint events;
  vec3 direction;
  uint reflections;
  vec3 stepX, stepY;
};
struct Moved {
  vec3 position;
  uint triangles;
};
struct ChainResult {
  Moved base, lowX, highX, lowY, highY;
  vec3 slopeX, slopeY;
};

/// A ball of `definition` with smooth normals between the camera at z = 3 and walls all around, and a mirror beside it.
Scene ballInABox(const Material& definition) {
  SceneBuilder builder;
  builder.icosphere(builder.material(definition), {0, 0, 0}, 1, 3, test::Facing::outside, test::Shading::smooth);
  builder.icosphere(builder.material(test::mirror()), {2.6, 0.3, 0.5}, 1.2, 3, test::Facing::outside,
                    test::Shading::smooth);
  builder.box(builder.material(test::diffuse(vec3(0.5f))), {-5, -5, -5}, {5, 5, 5}, test::Facing::inside);
  builder.pointLight({0, 4, 0}, vec3(1));
  return builder.finish();
}

std::vector<ChainItem> chainItems(const Scene& scene, uint events, uint reflections) {
  std::vector<ChainItem> items;
  std::mt19937 random(events + reflections);
  std::uniform_real_distribution<float> place(-0.26f, 0.26f);
  constexpr float kStep = 2e-4f;
  for (int i = 0; i < 256; ++i)
    items.push_back({vec3(dvec3(0, 0, 3) - scene.worldFromRender),
                     events,
                     {place(random), place(random), -1},
                     reflections,
                     {kStep, 0, 0},
                     {0, kStep, 0}});
  return items;
}

class DifferentialOnMeshes : public test::GpuTest {
 protected:
  /// That no footprint is more than 1 % from that of the moved paths that meet the same triangles.
  void expectFiniteDifferences(const Material& definition, uint events, uint reflections) const {
    const Scene scene = ballInABox(definition);
    int compared = 0;
    for (const ChainResult& r : runOnScene<test_kernels::DifferentialChain, ChainResult>(
             context(), scene, chainItems(scene, events, reflections))) {
      const uint way = r.base.triangles;
      if (way == 0 || r.lowX.triangles != way || r.highX.triangles != way || r.lowY.triangles != way ||
          r.highY.triangles != way)
        continue;
      ++compared;
      const vec3 x = 0.5f * (r.highX.position - r.lowX.position), y = 0.5f * (r.highY.position - r.lowY.position);
      ASSERT_LT(glm::length(r.slopeX - x), 0.01f * glm::length(x));
      ASSERT_LT(glm::length(r.slopeY - y), 0.01f * glm::length(y));
      const float area = glm::length(glm::cross(x, y)), own = glm::length(glm::cross(r.slopeX, r.slopeY));
      ASSERT_NEAR(own, area, 0.01f * glm::length(x) * glm::length(y));
    }
    EXPECT_GT(compared, 60);
  }
};

TEST_F(DifferentialOnMeshes, AfterAMirrorBallIsThatOfMovedPaths) { expectFiniteDifferences(test::mirror(), 1, 1); }
TEST_F(DifferentialOnMeshes, ThroughAGlassBallIsThatOfMovedPaths) { expectFiniteDifferences(test::glass(1.5f), 2, 0); }
TEST_F(DifferentialOnMeshes, TurnedBackInsideAGlassBallIsThatOfMovedPaths) {
  expectFiniteDifferences(test::glass(1.5f), 3, 2);
}

/// As in tests/kernels/sampled_spread.comp.
struct SpreadItem {
  vec3 wo;
  float uLobe;
  vec2 u;
  float samples;
};
struct SpreadResult {
  vec3 stepU, stepV, wi;
  float pdf;
};

std::vector<SpreadItem> spreadItems(float samples) {
  std::vector<SpreadItem> items;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.02f, 0.98f);
  for (int i = 0; i < 500; ++i) {
    const float z = 0.3f + 0.69f * unit(random), phi = 6.2831853f * unit(random), r = std::sqrt(1 - z * z);
    items.push_back({{r * std::cos(phi), r * std::sin(phi), z}, unit(random), {unit(random), unit(random)}, samples});
  }
  return items;
}

class SampledSpread : public test::GpuTest {};

TEST_F(SampledSpread, CoversTheSolidAngleOfASample) {
  constexpr float kSamples = 64;
  for (const Material& definition : {test::diffuse(vec3(0.5f)), test::metal(vec3(0.9f), 0.6f)}) {
    for (const SpreadResult& r : runOnScene<test_kernels::SampledSpread, SpreadResult>(
             context(), triangleOf(definition), spreadItems(kSamples))) {
      if (r.pdf <= 0 || std::max(glm::length(r.stepU), glm::length(r.stepV)) > 0.99f) continue;  // limited there
      const float across = std::abs(glm::dot(glm::cross(r.stepU, r.stepV), r.wi));
      ASSERT_NEAR(across * r.pdf * kSamples, 1.0f, 0.01f);
      ASSERT_LT(std::abs(glm::dot(r.stepU, r.wi)), 0.02f * glm::length(r.stepU)) << "not along the sphere";
    }
  }
}

/// On a ring of the disc the second number goes around by a quarter of pi for each half of its range.
TEST_F(SampledSpread, OfLambertsLawIsTheDerivativeOfTheDiscsMap) {
  constexpr float kSamples = 16;
  const auto items = spreadItems(kSamples);
  const auto results =
      runOnScene<test_kernels::SampledSpread, SpreadResult>(context(), triangleOf(test::diffuse(vec3(0.5f))), items);
  int compared = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const vec2 p = 2.0f * items[i].u - 1.0f;
    if (std::abs(p.x) < std::abs(p.y) + 0.02f) continue;
    ++compared;
    ASSERT_NEAR(glm::length(results[i].stepV), static_cast<float>(M_PI / 2) / std::sqrt(kSamples), 2e-3f);
    ASSERT_NEAR(results[i].stepV.z, 0.0f, 2e-3f);
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace importon
