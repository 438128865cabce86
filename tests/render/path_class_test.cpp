// Light paths of each class, counted once: the photon map against the path tracer. In Heckbert's notation L is
// the light, D a diffuse event, S a specular one, E the eye. [Heckbert 1990]
#include <ostream>
#include <string>

#include "render_helper.h"

namespace importon::test {
namespace {

constexpr int kSize = 8;

struct PathClass {
  std::string name;
  void (*build)(SceneBuilder&);
  int maxDepth;  // scattering events of the paths
};

std::ostream& operator<<(std::ostream& stream, const PathClass& c) { return stream << c.name; }

class PathClasses : public RenderTest, public ::testing::WithParamInterface<PathClass> {};

uint white(SceneBuilder& builder) { return builder.material(diffuse(vec3(0.8f))); }

void addFloor(SceneBuilder& builder) { builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 12); }

void addLight(SceneBuilder& builder, const glm::dvec3& center, const glm::dvec3& normal, double side) {
  builder.square(builder.material(emitter(vec3(5.0f))), center, normal, side);
}

void lookAtFloor(SceneBuilder& builder) { builder.camera({0, 2, 2}, {0, 0, 0}, 0.5, kSize, kSize); }

void buildLD(SceneBuilder& builder) {
  addFloor(builder);
  addLight(builder, {0.5, 2.5, -1}, {0, -1, 0}, 1);
  lookAtFloor(builder);
}

void buildLDD(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(white(builder), {0, 2, -2}, {0, 0, 1}, 8);
  addLight(builder, {0, 1, -1.2}, {0, 0, -1}, 1);  // lights the wall alone
  lookAtFloor(builder);
}

/// The light faces away from the floor, to a mirror above.
void buildLSD(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(builder.material(mirror(vec3(0.9f))), {0, 3, -1}, {0, -1, 0}, 6);
  addLight(builder, {0, 1, -1.5}, {0, 1, 0}, 1);
  lookAtFloor(builder);
}

/// The same caustic, on a wall that lights the floor.
void buildLSDD(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(white(builder), {0, 2, -2}, {0, 0, 1}, 8);
  builder.square(builder.material(mirror(vec3(0.9f))), {0, 1.5, 2.5}, {0, 0, -1}, 2);
  addLight(builder, {0, 1.5, 0.8}, {0, 0, 1}, 1);
  builder.camera({0, 2.4, 0.6}, {0, 0, -0.6}, 0.5, kSize, kSize);
}

/// The floor's light, reflected by a mirror, lights a ceiling that the camera sees.
void buildLDSD(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(builder.material(mirror(vec3(0.9f))), {0, 1, -3}, {0, 0, 1}, 4);
  builder.square(white(builder), {0, 2, 0}, {0, -1, 0}, 3);
  addLight(builder, {0, 1, 0}, {0, -1, 0}, 1);
  builder.camera({0, 0.3, 1}, {0, 2, 0.2}, 0.5, kSize, kSize);
}

void buildLDSE(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(builder.material(mirror(vec3(0.9f))), {0, 1, -2}, {0, 0, 1}, 4);
  addLight(builder, {0.5, 2.5, 0}, {0, -1, 0}, 1);
  builder.camera({0, 1, 2}, {0, 0.6, -2}, 0.3, kSize, kSize);
}

void buildGlassBall(SceneBuilder& builder) {
  addFloor(builder);
  builder.icosphere(builder.material(glass(1.5f)), {0, 1, 0}, 0.7, 3, Facing::outside, Shading::smooth);
  addLight(builder, {0.3, 3, -0.4}, {0, -1, 0}, 1.5);
  builder.camera({0, 1.2, 4}, {0, 0.5, 0}, 0.6, kSize, kSize);
}

/// A floor under a rough sheet that lights it and through which it is seen.
void buildFrostedPane(SceneBuilder& builder) {
  Material frosted = thinGlass(1.5f);
  frosted.roughness = 0.5f;
  addFloor(builder);
  builder.square(builder.material(frosted), {0, 1, 0}, {0, 1, 0}, 3);
  addLight(builder, {0.3, 2, 0}, {0, -1, 0}, 1);
  builder.camera({0, 0.7, 2}, {0, 0, 0}, 0.4, kSize, kSize);
}

void buildThinPane(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(builder.material(thinGlass(1.5f)), {0, 1, 0}, {0, 1, 0}, 2);
  addLight(builder, {0.3, 2, 0}, {0, -1, 0}, 1);
  builder.camera({0, 0.7, 2}, {0, 0, 0}, 0.4, kSize, kSize);
}

void buildGlossyPlate(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(builder.material(metal(vec3(0.9f), 0.4f)), {0, 1.5, -2}, {0, -0.2, 1}, 3);
  addLight(builder, {0, 1, -0.5}, {0, 0, -1}, 1);
  builder.camera({0, 1.5, 2.5}, {0, 0.4, -1}, 0.7, kSize, kSize);
}

TEST_P(PathClasses, MapAndPathTracerAgree) {
  SceneBuilder builder;
  GetParam().build(builder);
  const Scene scene = builder.finish();
  RenderJob path = makeJob(Integrator::path, 1);
  path.gather = 128;  // paths per pixel
  path.maxDepth = GetParam().maxDepth;
  RenderJob photon = makeJob(Integrator::photon, 6);
  photon.maxDepth = GetParam().maxDepth;
  photon.photons = 1u << 13;
  photon.constantDensity = 2000;
  const Moments traced = meanOverSeeds(path, scene, 5), mapped = meanOverSeeds(photon, scene, 5);
  EXPECT_GT(traced.mean(), 0);
  EXPECT_TRUE(haveSameMean(traced, mapped, 9));
}

INSTANTIATE_TEST_SUITE_P(Of, PathClasses,
                         ::testing::Values(PathClass{"LD", buildLD, 4}, PathClass{"LDD", buildLDD, 4},
                                           PathClass{"LSD", buildLSD, 4}, PathClass{"LSDD", buildLSDD, 4},
                                           PathClass{"LDSD", buildLDSD, 4}, PathClass{"LDSE", buildLDSE, 4},
                                           PathClass{"GlassBall", buildGlassBall, 16},
                                           PathClass{"ThinPane", buildThinPane, 8},
                                           PathClass{"FrostedPane", buildFrostedPane, 8},
                                           PathClass{"GlossyPlate", buildGlossyPlate, 8}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace importon::test
