// The validation layer finds nothing to say about a render.
#include "render_helper.h"

namespace importon::test {
namespace {

class Validation : public RenderTest, public ::testing::WithParamInterface<Integrator> {};

TEST_P(Validation, IsSilent) {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.icosphere(builder.material(glass(1.5f, vec3(0.1f))), {0.3, -0.5, -0.2}, 0.35, 1, Facing::outside,
                    Shading::smooth);
  builder.square(builder.material(emitter(vec3(3.0f))), {0, 0.9, 0}, {0, -1, 0}, 0.6);
  builder.spotLight({-0.4, 0.3, 0.5}, {0, -1, 0}, vec3(1.0f), 0.2, 0.6);
  builder.environment(vec3(0.1f));
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, 16, 12);
  RenderJob job = makeJob(GetParam(), 2);
  job.validation = true;
  job.photonBatch = 1u << 12;
  job.aovs = {"albedo",
              "N",
              "P",
              "depth",
              "direct",
              "caustic",
              "indirect",
              "emission",
              "variance",
              "importance.global",
              "required.global",
              "density.global"};
  const Rendered r = renderScene(job, builder.finish());
  for (const Warning& warning : r.warnings) ADD_FAILURE() << warning.kind << ": " << warning.message;
  EXPECT_GT(meanOf(r.image), 0);
}

INSTANTIATE_TEST_SUITE_P(Both, Validation, ::testing::Values(Integrator::path, Integrator::photon),
                         [](const auto& test) { return test.param == Integrator::path ? "Path" : "Photon"; });

}  // namespace
}  // namespace importon::test
