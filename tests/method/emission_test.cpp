// Lights are chosen with the probability that is stated: by photons, by power or as a guide has learned, and for
// points.
#include <gtest/gtest.h>

#include <random>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"
#include "support/statistics.h"
#include "test_kernels/light_choice.h"

namespace importon::test::emission_test {
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
    const EmissionGuide guide = rig.trainedGuide(scene_, kind, 32);
    const auto guided = rig.emit(kind, &guide), plain = rig.emit(kind);
    const auto fluxGuided = fluxByOctant(guided, scene_.lights.size()),
               fluxPlain = fluxByOctant(plain, scene_.lights.size());
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

/// As in tests/kernels/light_choice.comp.
struct LightQuery {
  vec3 x;
  float u = 0;
  uint light = 0;
};
struct LightAnswer {
  uint chosen;
  float chosenProbability, probability, rest;
};

std::vector<LightAnswer> chooseLights(gpu::Context& context, const MapRig& rig,
                                      const std::vector<LightQuery>& queries) {
  const gpu::Kernel kernel(context, "light choice", test_kernels::LightChoice::kCode, specializations(rig.features()));
  const gpu::Buffer input = gpu::makeBuffer(context, "queries", std::span<const LightQuery>(queries));
  const gpu::Buffer output(context, "answers", queries.size() * sizeof(LightAnswer));
  gpu::Recorder recorder(context);
  recorder.dispatch(
      kernel,
      rig.buffersOf<test_kernels::LightChoice>(test_kernels::buffers::In{input}, test_kernels::buffers::Out{output}),
      queries.size(), static_cast<std::uint32_t>(queries.size()));
  recorder.submitAndWait();
  return output.download<LightAnswer>(queries.size());
}

// Some of the lights are hidden from some of the places, as the photons have found. What the choice leaves of its
// random number is uniform again.
TEST_F(EmissionTest, LightsForAPointAreChosenWithTheStatedProbability) {
  MapRig rig(context(), scene_, job_);
  rig.findImportance();
  static_cast<void>(rig.shoot(MapKind::global, DensityControl::off, 0));  // shows which lights reach where
  constexpr std::size_t kSamples = 50'000, kBins = 10;
  const std::vector<vec3> places{vec3(0.1f, -0.99f, 0.4f), vec3(-0.3f, -0.95f, 0.1f), vec3(0.2f, 0.97f, 0.1f),
                                 vec3(0.7f, 0.5f, -0.69f)};
  const double significance = sidak(kSignificance, static_cast<std::int64_t>(2 * places.size()));
  const std::size_t lights = scene_.lights.size();
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0, 0.99999994f);
  for (const vec3& x : places) {
    std::vector<LightQuery> queries(kSamples, LightQuery{x});
    for (LightQuery& query : queries) query.u = unit(random);
    for (uint i = 0; i < lights; ++i) queries[i].light = i;
    const auto answers = chooseLights(context(), rig, queries);
    std::vector<double> counts(lights), expected(lights), rests(kBins);
    for (std::size_t i = 0; i < lights; ++i) expected[i] = static_cast<double>(answers[i].probability);
    double sum = 0;
    for (const double p : expected) sum += p;
    ASSERT_NEAR(sum, 1, 1e-5);
    for (double& p : expected) p *= kSamples / sum;
    for (const LightAnswer& a : answers) {
      ++counts[a.chosen];
      ++rests[static_cast<std::size_t>(a.rest * static_cast<float>(kBins))];
      ASSERT_NEAR(a.chosenProbability / answers[a.chosen].probability, 1, 1e-5);
    }
    EXPECT_GT(chiSquareTest(counts, expected).pValue, significance);
    EXPECT_GT(
        chiSquareTest(rests, std::vector<double>(kBins, static_cast<double>(kSamples) / static_cast<double>(kBins)))
            .pValue,
        significance);
  }
}

}  // namespace
}  // namespace importon::test::emission_test
