// When gather rays read a cell, and that no light is too weak for one.
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test {
namespace {

class CellLight : public RenderTest {};

// A cell of a large wall is as large as the wall, which a spot lights in one half only. Gather rays of the
// floor before it come nearer than the cell is wide: a cell that was read would shine evenly.
TEST_F(CellLight, OfACellThatIsNearerThanItIsWideIsNotRead) {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.7f)));
  builder.square(white, {0, 0, 0.5}, {0, 1, 0}, 1);
  builder.square(white, {0, 0.5, 0}, {0, 0, 1}, 1);
  builder.spotLight({-0.3, 0.3, 0.8}, {0, 0, -1}, vec3(3), 0.2, 0.21);
  builder.camera({0, 0.9, 0.9}, {0, 0, 0.3}, 0.8, 8, 8);
  const Scene scene = builder.finish();
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 14;
  job.constantDensity = 1;
  job.maxDepth = 2;
  job.gather = 64;
  const auto halvesOf = [](const Rendered& r) {
    return std::vector<double>{meanOf(r.image, Region{0, 4, 4, 8}), meanOf(r.image, Region{4, 4, 8, 8})};
  };
  const std::vector<Moments> halves = overSeeds(job, scene, 4, halvesOf);
  RenderJob path = makeJob(Integrator::path, 2);
  path.maxDepth = 2;
  path.gather = 256;
  const std::vector<Moments> truth = overSeeds(path, scene, 4, halvesOf);
  for (const std::size_t half : {0u, 1u})
    EXPECT_NEAR(halves[half].mean() / truth[half].mean(), 1, 0.1) << "half " << half;
}

// A strong light in another sphere makes the units of power so large that a photon of the weak one is a
// fifteenth of a unit. Rounded at random they come to what they are: E = power / (4 pi R² (1 - albedo)), known
// to 5 % of four seeds; rounded down they come to nothing, and half of the light is missing.
TEST_F(CellLight, OfLessThanAUnitAPhotonIsKept) {
  SceneBuilder builder;
  const uint walls = builder.material(diffuse(vec3(0.5f)));
  builder.icosphere(walls, {0, 0, 0}, 1, 3, Facing::inside, Shading::flat);
  builder.icosphere(walls, {3, 0, 0}, 1, 3, Facing::inside, Shading::flat);
  builder.pointLight({0, 0, 0}, vec3(1.0f));
  builder.pointLight({3, 0, 0}, vec3(1e14f));
  builder.camera({0.1, 0.2, 0.5}, {0, 0, -1}, 1.0, 8, 8);
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 14;
  job.maxDepth = 24;
  job.gather = 64;
  const double expected = 0.5 / glm::pi<double>() * 1 / 0.5;
  EXPECT_NEAR(meanOverSeeds(job, builder.finish(), 4).mean() / expected, 1, 0.2);
}

}  // namespace
}  // namespace importon::test
