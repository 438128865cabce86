// The power that photons bring.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::flux_test {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kAlbedo = 0.5;

class Flux : public RenderTest {};

SceneBuilder withCamera() {
  SceneBuilder builder;
  builder.camera({0.1, 0.2, 0.5}, {0, 0, -1}, 1.0, 16, 16);
  return builder;
}

/// A grey icosphere of radius 2, of inner faces, lit from its centre by 12 W in each channel.
Scene litSphere(int subdivisions = 2) {
  SceneBuilder builder = withCamera();
  const uint walls = builder.material(diffuse(vec3(static_cast<float>(kAlbedo))));
  builder.icosphere(walls, {0, 0, 0}, 2, subdivisions, Facing::inside, Shading::flat);
  builder.pointLight({0, 0, 0}, vec3(static_cast<float>(12 / (4 * kPi))));
  return builder.finish();
}

double areaOf(const Scene& scene) {
  double area = 0;
  for (const Triangle& t : scene.triangles) {
    const glm::dvec3 a(scene.positions[t.v0]), b(scene.positions[t.v1]), c(scene.positions[t.v2]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

/// W from one square of 4 m to another 1 m over it, for radiance 1. [Howell, A Catalog of Radiation Heat
/// Transfer Configuration Factors, C-11]
double oppositeSquares() {
  constexpr double kX = 4, kRoot = 17;  // side over distance; 1 + x²
  const double factor = 2 / (kPi * kX * kX) *
                        (std::log(kRoot / std::sqrt(1 + 2 * kX * kX)) +
                         2 * kX * std::sqrt(kRoot) * std::atan(kX / std::sqrt(kRoot)) - 2 * kX * std::atan(kX));
  return kPi * 16 * factor;
}

RenderJob photonJob(int passes = 1) {
  RenderJob job = makeJob(Integrator::photon, passes);
  job.photons = 1u << 12;
  job.maxDepth = 24;
  return job;
}

/// Moments of the red power of all hits of the global map.
Moments hitFluxOverSeeds(const RenderJob& job, const Scene& scene) {
  return overSeeds(job, scene, 8, [](const Rendered& r) { return std::vector{r.stats.global.fluxHits[0]}; }).front();
}

TEST_F(Flux, OfAllHitsInClosedRoomIsPowerOverAbsorption) {
  const StabilityCase listed(4, "power of all photon hits in a closed room", "power / (1 - albedo)");
  EXPECT_TRUE(isWithin(0.01, hitFluxOverSeeds(photonJob(), litSphere()), 12 / (1 - kAlbedo)));
}

TEST_F(Flux, OfTheMapIsThatOfItsHitsToTheLastBit) {
  StabilityCase listed(4, "power of the map against that of its hits", "equal, to the last bit");
  const Scene scene = litSphere();
  for (const DensityControl control : {DensityControl::off, DensityControl::density}) {
    for (const std::optional<int> receivers :
         {std::optional<int>(), std::optional(1), std::optional(4), std::optional(20)}) {
      for (const std::uint32_t batch : {1u << 12, 1u << 16}) {
        RenderJob job = photonJob();
        job.control = control;
        job.redistribute = receivers;
        job.photonBatch = batch;
        job.photons = 1u << 14;
        job.constantDensity = 20;  // 1000 photons in all: most are redistributed
        const PhotonMapStats map = renderScene(job, scene).stats.global;
        EXPECT_EQ(map.fluxMap, map.fluxHits);
        EXPECT_GT(map.fluxHits[0], 0);
        EXPECT_EQ(map.stored + map.redistributed, map.hits);
        EXPECT_EQ(map.redistributed > map.hits / 2, control == DensityControl::density);
        if (control == DensityControl::off) break;
      }
      if (control == DensityControl::off) break;
    }
  }
  listed.note("equal", 1);
}

TEST_F(Flux, DoesNotDependOnBatches) {
  StabilityCase listed(29, "photons in batches of other sizes", "the same photons and power");
  const Scene scene = litSphere();
  RenderJob job = photonJob();
  const PhotonMapStats whole = renderScene(job, scene).stats.global;
  job.photonBatch = 1u << 10;
  const PhotonMapStats split = renderScene(job, scene).stats.global;
  EXPECT_EQ(whole.fluxHits, split.fluxHits);
  EXPECT_EQ(whole.hits, split.hits);
  EXPECT_EQ(whole.stored, split.stored);  // case 29
  listed.note("equal", 1);
}

TEST_F(Flux, OnWallsOfSphereGivesTheirRadiance) {
  const StabilityCase listed(3, "point light in a diffuse sphere", "E = power / (4 pi R² (1 - albedo))");
  const Scene scene = litSphere(4);
  const double expected = kAlbedo / kPi * 12 / (areaOf(scene) * (1 - kAlbedo));
  RenderJob photon = photonJob(2);
  photon.photons = 1u << 15;
  EXPECT_TRUE(isWithin(0.01, meanOverSeeds(photon, scene, 8), expected));
  RenderJob job = makeJob(Integrator::path, 64);
  job.maxDepth = 24;
  EXPECT_TRUE(isWithin(0.01, momentsOf(valuesOf(renderScene(job, scene).image)), expected));
}

TEST_F(Flux, OfEveryEmissionIsItsPower) {
  struct Case {
    const char* name;
    std::function<void(SceneBuilder&)> addLight;
    double expected;  // W on the floor, 4 m x 4 m
  };
  const double cosInner = std::cos(0.2), cosOuter = std::cos(0.5);
  const std::vector<Case> cases = {
      {"spot",
       [](SceneBuilder& b) {
         b.spotLight({0, 1, 0}, {0, -1, 0}, vec3(3.0f), 0.2, 0.5);
       },
       2 * kPi * 3 * ((1 - cosInner) + (cosInner - cosOuter) / 3)},
      {"directional",
       [](SceneBuilder& b) {
         b.directionalLight({0.6, -0.8, 0}, vec3(2.0f));
       },
       2 * 16 * 0.8},
      {"environment", [](SceneBuilder& b) { b.environment(vec3(0.5f)); }, kPi * 0.5 * 16 * 2},  // both sides
      {"environment map",
       [](SceneBuilder& b) {
         b.environment(EnvironmentMap{1, 2, {vec3(0.5f), vec3(0.5f)}});
       },
       kPi * 0.5 * 16 * 2},
      {"triangles",
       [](SceneBuilder& b) {
         b.square(b.material(emitter(vec3(4.0f))), {0, 1, 0}, {0, -1, 0}, 4);
       },
       4 * oppositeSquares()},
      {"two-sided triangles",
       [](SceneBuilder& b) {
         b.square(b.material(emitter(vec3(4.0f), true)), {0, 1, 0}, {0, 1, 0}, 4);
       },
       4 * oppositeSquares()}};
  RenderJob job = photonJob();
  job.photons = 1u << 16;
  for (const Case& c : cases) {
    SceneBuilder builder = withCamera();
    builder.square(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {0, 1, 0}, 4);
    c.addLight(builder);
    EXPECT_TRUE(isWithin(0.01, hitFluxOverSeeds(job, builder.finish()), c.expected)) << c.name;
  }
}

TEST_F(Flux, HasNoCausticMapWithoutSpecularSurfaces) {
  StabilityCase listed(26, "no specular surface", "no caustic map");
  const Rendered r = renderScene(photonJob(), litSphere());
  EXPECT_EQ(r.stats.caustic.hits, 0u);
  for (const std::string& feature : r.stats.features) EXPECT_NE(feature, "caustic map");
  for (const KernelStats& kernel : r.stats.kernels) EXPECT_EQ(kernel.label.find("caustic"), std::string::npos);
  listed.note("none", 1);
}

TEST_F(Flux, OfInfiniteRequiredDensityIsTheUncontrolledMap) {
  const StabilityCase listed(27, "required density without bound", "the uncontrolled map, bit for bit");
  const Scene scene = litSphere();
  RenderJob job = photonJob();
  job.gatherFrom = GatherSource::photons;
  job.constantDensity = 1e9;
  const Rendered controlled = renderScene(job, scene);
  job.control = DensityControl::off;
  const Rendered free = renderScene(job, scene);
  EXPECT_EQ(controlled.stats.global.redistributed, 0u);
  EXPECT_TRUE(haveSameBits(controlled.image, free.image));
}

}  // namespace
}  // namespace importon::test::flux_test
