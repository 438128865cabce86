// Gather rays that read surface cells, and lights chosen by where photons came from.
#include "render_helper.h"

namespace importon::test::cells_test {
namespace {

constexpr int kSize = 8;

class Cells : public RenderTest {};

Material plastic(vec3 color, float roughness) {
  Material m = diffuse(color);
  m.specular = 1;
  m.roughness = roughness;
  return m;
}

/// A closed box of 2 m whose walls are `wall`, lit by a lamp that the camera does not see.
Scene boxOf(const Material& wall) {
  SceneBuilder builder;
  const uint w = builder.material(wall);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 normal(0);
      normal[axis] = -side;
      builder.square(w, -normal, normal, 2);
    }
  }
  builder.square(builder.material(emitter(vec3(20.0f))), {0, 0.9, 0}, {0, -1, 0}, 0.3);
  builder.camera({0, -0.2, 0.9}, {0, -0.4, -1}, 0.9, kSize, kSize);
  return builder.finish();
}

TEST_F(Cells, HoldWhatThePathTracerFinds) {
  Material metal = plastic(vec3(0.7f), 0.4f);
  metal.metallic = 0.5f;
  for (const Material& wall : {diffuse(vec3(0.6f)), plastic(vec3(0.6f), 0.3f), metal}) {
    const Scene scene = boxOf(wall);
    RenderJob job = makeJob(Integrator::photon, 4);
    job.photons = 1u << 14;
    job.gather = 64;
    RenderJob path = makeJob(Integrator::path, 4);
    path.gather = 64;
    EXPECT_TRUE(areWithin(0.02, meanOverSeeds(job, scene, 8), meanOverSeeds(path, scene, 8)));
  }
}

TEST_F(Cells, GoOnToHoldItWhenTheyAreCutAnew) {
  const Scene scene = boxOf(diffuse(vec3(0.6f)));
  const RenderJob job = makeJob(Integrator::photon, 12);
  RenderJob path = makeJob(Integrator::path, 12);
  path.gather = 16;
  EXPECT_TRUE(areWithin(0.02, meanOverSeeds(job, scene, 8), meanOverSeeds(path, scene, 8)));
}

TEST_F(Cells, AreAsManyAsTheRequiredDensityAsks) {
  const Scene scene = boxOf(diffuse(vec3(0.6f)));
  RenderJob job = makeJob(Integrator::photon, 1);
  job.photons = 1u << 16;
  job.constantDensity = 50;
  const Rendered r = renderScene(job, scene);
  constexpr double kArea = 24;  // m², of the walls' inner sides
  EXPECT_GT(static_cast<double>(r.stats.global.stored), 0.9 * 50 * kArea);
  EXPECT_LT(static_cast<double>(r.stats.global.stored), 1.4 * 50 * kArea);
  EXPECT_EQ(r.stats.global.stored + r.stats.global.redistributed, r.stats.global.hits);
  EXPECT_EQ(r.stats.global.fluxHits, r.stats.global.fluxMap);
}

/// Eight lamps light a floor, of which seven are behind a wall.
TEST_F(Cells, SeeWhichLightsArriveSoThatHiddenOnesAddLittleNoise) {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.5f)));
  builder.square(white, {0, 0, 0}, {0, 1, 0}, 8);
  builder.square(white, {0.5, 2, 0}, {-1, 0, 0}, 8);
  for (int i = 0; i < 7; ++i) builder.pointLight({1, 0.5, 0.2 * (i - 3)}, vec3(10));
  builder.pointLight({-1, 2, 0}, vec3(10));
  builder.camera({-1, 1, 0.1}, {-0.5, 0, 0}, 0.5, kSize, kSize);
  const Scene scene = builder.finish();
  const auto noise = [&](Integrator integrator) {
    RenderJob job = makeJob(integrator, 2);
    job.photons = 1u << 16;
    job.maxDepth = 1;
    const std::vector<Moments> pixels = overSeeds(job, scene, 6, [](const Rendered& r) {
      const std::vector<float> values = valuesOf(r.image);
      return std::vector<double>(values.begin(), values.end());
    });
    double variance = 0, square = 0;
    for (const Moments& m : pixels) {
      variance += m.variance();
      square += m.mean() * m.mean();
    }
    return variance / square;
  };
  EXPECT_LT(noise(Integrator::photon), 0.3 * noise(Integrator::path));
}

}  // namespace
}  // namespace importon::test::cells_test
