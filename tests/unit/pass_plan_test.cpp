#include "render/plan/pass_plan.h"

#include <gtest/gtest.h>

namespace importon::pass_plan_test {
namespace {

RenderJob jobOf(std::optional<double> seconds) {
  RenderJob job;
  job.seconds = seconds;
  return job;
}

PassPlan planFor(const RenderJob& job) {
  FeatureSet features;
  features.needsCausticMap = true;
  gpu::Limits limits{};
  limits.isCpu = true;
  limits.maxStorageBufferRange = 1u << 30;
  limits.heapBytes = std::uint64_t{4} << 30;
  return planPasses(job, features, {640, 480}, limits);
}

TEST(PassPlan, IsSmallerWhereTimeIsShort) {
  const PassPlan calm = planFor(jobOf({})), quick = planFor(jobOf(2));
  EXPECT_EQ(planFor(jobOf(100)).whole.photons, calm.whole.photons);
  EXPECT_EQ(quick.whole.photons, calm.whole.photons / 4);
  EXPECT_EQ(quick.whole.causticPhotons, calm.whole.causticPhotons / 4);
  EXPECT_EQ(quick.importons, calm.importons / 4);
  EXPECT_EQ(quick.batch, calm.batch / 4);
  EXPECT_EQ(planFor(jobOf(0.01)).whole.photons, calm.whole.photons / 8);
}

TEST(PassPlan, TakesThePhotonsThatAreAskedForHoweverShortTimeIs) {
  RenderJob job = jobOf(2);
  job.photons = 1u << 20;
  EXPECT_EQ(planFor(job).whole.photons, 1u << 19);  // half for each map
}

TEST(PassPlan, WithACheckpointDoesNotDependOnTime) {
  RenderJob job = jobOf(2);
  job.checkpoint = "state";
  EXPECT_EQ(planFor(job).importons, planFor(jobOf({})).importons);
}

}  // namespace
}  // namespace importon::pass_plan_test
