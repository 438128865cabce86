// Photons as they leave the lights: chosen by power, or as a guide has learned, with the flux that makes up for it.
#include <gtest/gtest.h>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"

namespace importon::test {
namespace {

constexpr double kSignificance = 1e-3;
constexpr uint kPhotons = 1u << 16;

/// A room with lights of each kind but the environment, very unlike in power, and a glass ball that the camera sees.
Scene room() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(40))), {0.2, 0.98, 0.1}, {0, -1, 0}, 0.2);
  builder.square(builder.material(emitter(vec3(3))), {-0.6, 0.98, 0.1}, {0, -1, 0}, 0.1);
  builder.icosphere(builder.material(glass(1.5f)), {-0.3, -0.6, 0.1}, 0.3, 2, Facing::outside, Shading::smooth);
  builder.pointLight({0.7, 0.5, -0.7}, vec3(0.2f));
  builder.spotLight({0.1, 0.5, 0.7}, {-0.3, -1, -0.5}, vec3(2), 0.2, 0.6);
  builder.camera({-0.3, 0, 0.9}, {-0.35, -1, 0.05}, 0.6, 24, 24);
  return builder.finish();
}

class EmissionTest : public GpuTest {
 protected:
  EmissionTest() {
    job_.photons = 2 * kPhotons;  // for two maps
    job_.photonBatch = kPhotons;
    job_.importons = 1u << 12;
    job_.seed = 3;
  }

  RenderJob job_;
  const Scene scene_ = room();
};

TEST_F(EmissionTest, LightsAreChosenByTheirPowerWithAnEvenShare) {
  MapRig rig(context(), scene_, job_);
  ASSERT_EQ(rig.plan.batch, kPhotons);
  double power = 0;
  for (const Light& light : scene_.lights) power += light.power;
  std::vector<double> counts(scene_.lights.size()), expected;
  for (const EmittedPhoton& photon : rig.emit(MapKind::global)) counts[photon.light] += 1;
  const double even = 0.05 / static_cast<double>(scene_.lights.size());
  for (const Light& light : scene_.lights) expected.push_back((0.95 * light.power / power + even) * kPhotons);
  EXPECT_GT(chiSquareTest(counts, expected).pValue, kSignificance);
}

constexpr std::size_t kOctants = 8;

/// Flux that leaves each light into each octant of directions, W: moments over all photons.
std::vector<Moments> fluxByOctant(const std::vector<EmittedPhoton>& photons, std::size_t lights) {
  std::vector<Moments> flux(lights * kOctants);
  for (const EmittedPhoton& p : photons) {
    const std::size_t octant = (p.direction.x > 0 ? 1 : 0) + (p.direction.y > 0 ? 2 : 0) + (p.direction.z > 0 ? 4 : 0);
    for (std::size_t i = 0; i < flux.size(); ++i)
      flux[i].add(i == p.light * kOctants + octant ? static_cast<double>(p.flux.y) * kPhotons : 0);
  }
  return flux;
}

// The samples are drawn from the density that their weights state if the weighted sums are those without a guide, in
// every part of the domain. That the guide prefers some parts is what its gain says.
TEST_F(EmissionTest, AGuidesPhotonsHaveTheDensityThatTheirFluxStates) {
  MapRig rig(context(), scene_, job_);
  rig.findImportance();
  for (const MapKind kind : {MapKind::caustic, MapKind::global}) {
    const EmissionGuide guide = rig.teachGuide(scene_, kind, 32);
    const auto guided = rig.emit(kind, &guide), plain = rig.emit(kind);
    const auto fluxGuided = fluxByOctant(guided, scene_.lights.size()), fluxPlain = fluxByOctant(plain, scene_.lights.size());
    const double significance = sidak(kSignificance, static_cast<std::int64_t>(2 * fluxPlain.size()));
    for (std::size_t i = 0; i < fluxPlain.size(); ++i) {
      const Moments &g = fluxGuided[i], &p = fluxPlain[i];
      EXPECT_GT(zTest(g.mean(), g.standardError(), p.mean(), p.standardError()).pValue, significance)
          << "light " << i / kOctants << " octant " << i % kOctants << ": " << g.mean() << " and " << p.mean();
    }
    if (kind == MapKind::caustic) {
      EXPECT_GT(guide.gain(), 1.5);
    }
  }
}

}  // namespace
}  // namespace importon::test
