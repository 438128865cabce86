// Cameras and materials at the edge of numbers.
#include "render_helper.h"

namespace importon::test {
namespace {

class HardViews : public RenderTest {};

SceneBuilder litBox() {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(3.0f))), {0, 0.9, 0}, {0, -1, 0}, 0.6);
  return builder;
}

TEST_F(HardViews, OfAnyAngleAreFinite) {
  const StabilityCase listed(48, "angles of view 1e-6 to pi - 1e-6", "finite, energy exact");
  for (const double angle : {1e-6, 3.1, 3.1415916}) {
    SceneBuilder builder = litBox();
    builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, angle, 8, 8);
    const Rendered r = renderScene(makeJob(Integrator::photon, 2), builder.finish());
    EXPECT_TRUE(isSane(r.image)) << angle;
    EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits) << angle;
  }
}

TEST_F(HardViews, OfOneRowAreFinite) {
  const StabilityCase listed(49, "images of 1 x 512 and 512 x 1 pixels", "finite, lit");
  for (const glm::ivec2 size : {glm::ivec2(1, 512), glm::ivec2(512, 1)}) {
    SceneBuilder builder = litBox();
    builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 0.5, size.x, size.y);
    const Image image = renderScene(makeJob(Integrator::photon, 1), builder.finish()).image;
    EXPECT_TRUE(isSane(image));
    EXPECT_GT(meanOf(image), 0);
  }
}

/// Each value at its limits, in one scene.
TEST_F(HardViews, OfMaterialsAtTheirLimitsAreFinite) {
  const StabilityCase listed(50, "roughness 1e-9, ior 1e4 and 1 + 1e-7, absorption 1e30, coats, black and white",
                             "finite, energy exact");
  SceneBuilder builder = litBox();
  std::vector<Material> materials = {metal(vec3(1.0f), 1e-9f), metal(vec3(0.0f), 1.0f),  glass(1e4f),
                                     glass(1.0000001f),        glass(1.5f, vec3(1e30f)), thinGlass(1.0f),
                                     diffuse(vec3(1.0f))};
  Material coated = metal(vec3(1.0f), 0.5f), frosted = glass(1.5f);
  coated.clearcoat = 1;
  coated.clearcoatRoughness = 1e-4f;
  frosted.roughness = 1;
  frosted.specular = 0;
  materials.insert(materials.end(), {coated, frosted});
  for (std::size_t i = 0; i < materials.size(); ++i)
    builder.icosphere(builder.material(materials[i]), {-0.8 + 0.2 * static_cast<double>(i), -0.5, 0}, 0.09, 2,
                      Facing::outside, Shading::smooth);
  builder.camera({0.1, 0.2, 0.9}, {0, -0.5, 0}, 1.3, 24, 12);
  for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
    const Rendered r = renderScene(makeJob(integrator, 2), builder.finish());
    EXPECT_TRUE(isSane(r.image));
    EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits);
    EXPECT_EQ(r.stats.caustic.fluxMap, r.stats.caustic.fluxHits);
  }
}

/// Triangles that meet at right angles on planes of the grid: positions fall on borders of its cells.
TEST_F(HardViews, OfSurfacesOnBordersOfCellsKeepAllPower) {
  const StabilityCase listed(51, "all surfaces on borders of the grid's cells", "power exact, finite");
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.5f))), {0, 0, 0}, {1, 1, 1}, Facing::inside, 16);
  builder.pointLight({0.5, 0.5, 0.5}, vec3(1.0f));
  builder.camera({0.5, 0.5, 0.9}, {0.5, 0.5, 0}, 1.3, 8, 8);
  for (const DensityControl control : {DensityControl::off, DensityControl::density, DensityControl::probability}) {
    RenderJob job = makeJob(Integrator::photon, 2);
    job.control = control;
    const Rendered r = renderScene(job, builder.finish());
    EXPECT_TRUE(isSane(r.image));
    if (control != DensityControl::probability) {
      EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits);
    }
  }
}

}  // namespace
}  // namespace importon::test
