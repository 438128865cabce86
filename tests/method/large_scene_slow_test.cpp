// Large scenes fit in modest memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "method/render_scene.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon {
namespace {

class LargeScene : public test::GpuTest {};

TEST_F(LargeScene, OfAMillionTrianglesRendersWithinTwoGibibytesOfHostAndOneOfDeviceMemory) {
  test::SceneBuilder builder;
  builder.box(builder.material(test::diffuse(vec3(0.7f))), {-1, -1, -1}, {1, 1, 1}, test::Facing::inside, 290);
  builder.square(builder.material(test::emitter(vec3(5))), {0, 0.9, 0}, {0, -1, 0}, 0.5);
  builder.camera({0, 0, 0.9}, {0, 0, 0}, 1.0, 640, 480);
  RenderJob job;
  job.passes = 1;
  const Scene scene = builder.finish();
  ASSERT_GE(scene.triangles.size(), 1'000'000u);
  const RenderResult result = test::renderScene(scene, job);
  EXPECT_GT(test::meanOf(result), 0);
  EXPECT_LT(result.stats.devicePeakBytes, 1ull << 30);
  rusage usage{};
  ASSERT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
  EXPECT_LT(usage.ru_maxrss, 2l << 20);  // KiB
}

}  // namespace
}  // namespace importon
