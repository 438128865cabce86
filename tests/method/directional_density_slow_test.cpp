// What directional importance is worth where caustics fall on glossy surfaces: photons whose light the camera does not
// see are not required, and the image's error stays.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "method/render_scene.h"
#include "support/claims.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon {
namespace {

class DirectionalDensity : public test::GpuTest {};

constexpr double kMostError = 1.1;

/// A glass ball on a brushed metal table. One lamp is behind it, so that the table throws its caustic towards the
/// camera; the caustics of two other ones go elsewhere.
Scene brushedTable() {
  test::SceneBuilder builder;
  builder.square(builder.material(test::metal(vec3(0.9f, 0.8f, 0.7f), 0.5f)), {0, 0, 0}, {0, 1, 0}, 5);
  builder.icosphere(builder.material(test::glass(1.5f)), {0, 0.5, 0}, 0.4, 4, test::Facing::outside,
                    test::Shading::smooth);
  const uint lamp = builder.material(test::emitter(vec3(150)));
  for (const glm::dvec3& place : {glm::dvec3(0, 1.8, -3), glm::dvec3(1.5, 2.5, 2), glm::dvec3(-2, 2.5, 1)})
    builder.square(lamp, place, glm::normalize(-place), 0.2);
  builder.camera({0, 1.2, 3}, {0, 0.2, 0}, 0.6, 64, 64);
  return builder.finish();
}

RenderJob tableJob(std::uint32_t seed) {
  RenderJob job;
  job.passes = 2;
  job.photons = 1u << 18;
  job.importons = 1u << 13;
  job.seed = seed;
  return job;
}

TEST_F(DirectionalDensity, StoresFewerPhotonsAtTheSameError) {
  const Scene scene = brushedTable();
  RenderJob many = tableJob(1000);
  many.control = DensityControl::off;
  many.passes = 16;
  const RenderResult reference = test::renderScene(scene, many);
  test::Moments stored, errors;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    RenderJob job = tableJob(seed);
    const RenderResult plain = test::renderScene(scene, job);
    job.requiredBy = RequiredBy::direction;
    const RenderResult directional = test::renderScene(scene, job);
    stored.add(static_cast<double>(directional.stats.caustic.stored) / static_cast<double>(plain.stats.caustic.stored));
    errors.add(std::log(test::relativeError(directional, reference) / test::relativeError(plain, reference)));
  }
  std::printf("brushed table: photons %.3f, error %.3f, standard error %.3f\n", stored.mean(), std::exp(errors.mean()),
              errors.standardError());
  EXPECT_TRUE(test::isBelow(0.8, stored));
  EXPECT_TRUE(test::isBelow(std::log(kMostError), errors));
}

}  // namespace
}  // namespace importon
