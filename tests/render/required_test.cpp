// Required density that knows more than importance, and lookups that choose their photons: fewer photons are stored, or
// other ones are read, and the image keeps its mean.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "render/features/feature_set.h"
#include "render/plan/pass_plan.h"
#include "render_helper.h"

namespace importon::test {
namespace {

class Required : public RenderTest {};

/// A glass ball over a floor that is a little glossy, lit by a small lamp, whose light it focuses, and by a strong
/// light that shines on the floor below the edge of a wall, misses the ball and drowns the caustic. The camera sees the
/// floor.
Scene drownedCaustic() {
  SceneBuilder builder;
  Material floor = diffuse(vec3(0.5f));
  floor.specular = 1;
  floor.roughness = 0.4f;
  builder.square(builder.material(floor), {0, 0, 0}, {0, 1, 0}, 4);
  builder.icosphere(builder.material(glass(1.5f)), {0, 0.6, 0}, 0.4, 3, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(vec3(40))), {0, 3, 0}, {0, -1, 0}, 0.3);
  builder.square(builder.material(diffuse(vec3(0.1f))), {0.8, 1.13, 0}, {1, 0, 0}, 2);
  builder.pointLight({1.3, 0.1, 0}, vec3(100));
  builder.camera({0, 1, 3}, {0, 0, 0}, 0.6, 64, 64);
  return builder.finish();
}

RenderJob requiredJob() {
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 16;
  job.importons = 1u << 13;
  job.causticDensity = 16;  // less than photons bring; with much less, most are stored where no less can be required
  job.gather = 1;
  return job;
}

struct Outcome {
  std::vector<double> images;  // mean of each seed's
  double stored = 0;
};

Outcome outcomeOf(RenderJob job, const Scene& scene) {
  Outcome outcome;
  for (job.seed = 1; job.seed <= 5; ++job.seed) {
    const Rendered rendered = renderScene(job, scene);
    outcome.images.push_back(meanOf(rendered.image));
    outcome.stored += static_cast<double>(rendered.stats.caustic.stored);
  }
  return outcome;
}

TEST_F(Required, LessWhereCausticsDoNotShowKeepsTheMean) {
  const Scene scene = drownedCaustic();
  RenderJob job = requiredJob();
  const Outcome plain = outcomeOf(job, scene);
  job.requiredBy = RequiredBy::contribution;
  const Outcome contribution = outcomeOf(job, scene);
  job.requiredBy = RequiredBy::direction;
  const Outcome direction = outcomeOf(job, scene);
  EXPECT_TRUE(isWithin(0.01, ratiosOf(contribution.images, plain.images), 1));
  EXPECT_TRUE(isWithin(0.01, ratiosOf(direction.images, plain.images), 1));
  EXPECT_LT(contribution.stored, 0.8 * plain.stored);
  EXPECT_LT(direction.stored, 0.8 * plain.stored);
}

TEST_F(Required, NumberOfPhotonsOfALookupIsChosen) {
  RenderJob job = requiredJob();
  job.choosesLookups = true;
  const Rendered rendered = renderScene(job, drownedCaustic());
  EXPECT_TRUE(isSane(rendered.image));
  EXPECT_GT(rendered.stats.photonsPilot, 2 * (job.photons.value() / 2)) << "no map was tried";
  EXPECT_EQ(rendered.stats.caustic.fluxHits, rendered.stats.caustic.fluxMap);
}

/// A lookup of the caustic map that reads M of M_r photons per pixel footprint covers M/M_r of the footprint.
TEST(CausticLookup, CoversNoMoreThanAPixelsFootprint) {
  const Scene scene = drownedCaustic();
  RenderJob job = requiredJob();
  const auto photonsOf = [&](double density) {
    job.causticDensity = density;
    const FeatureSet features = findFeatures(scene, job);
    gpu::Limits limits;
    limits.maxStorageBufferRange = limits.heapBytes = 1ull << 30;
    const PassPlan plan = planPasses(job, features, {64, 64}, limits);
    return makeParameters(job, scene, plan, allOf({64, 64})).causticMap.lookupPhotons;
  };
  EXPECT_EQ(photonsOf(40), 20);
  EXPECT_EQ(photonsOf(20), 20);
  EXPECT_EQ(photonsOf(10), 10);
  EXPECT_EQ(photonsOf(1), 5) << "too few to tell light from none";
  job.lookupPhotons = 12;
  EXPECT_EQ(photonsOf(5), 12);
}

}  // namespace
}  // namespace importon::test
