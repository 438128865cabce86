// Light paths of each class, counted once: the photon map against the path tracer. In Heckbert's notation L is
// the light, D a diffuse event, S a specular one, E the eye. [Heckbert 1990]
#include <optional>
#include <ostream>
#include <string>

#include "render_helper.h"

namespace importon::test::path_class_test {
namespace {

constexpr int kSize = 8;

struct PathClass {
  std::string name;
  void (*build)(SceneBuilder&);
  int paths;                           // per pixel, of the path tracer
  int gather;                          // rays per pixel and pass of the photon map's image
  int log2Photons;                     // per pass
  bool hasGather = false;              // so that it differs where gather rays read
  std::optional<double> density = {};  // of the map of photons, 1/m²: where edges are near, lookups must be narrow
};

std::ostream& operator<<(std::ostream& stream, const PathClass& c) { return stream << c.name; }

class PathClasses : public RenderTest, public ::testing::WithParamInterface<PathClass> {};

uint white(SceneBuilder& builder) { return builder.material(diffuse(vec3(0.8f))); }

uint black(SceneBuilder& builder) { return builder.material(diffuse(vec3(0.0f))); }

uint silver(SceneBuilder& builder) { return builder.material(mirror(vec3(0.9f))); }

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

/// The light shines on a wall alone.
void buildLDD(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(white(builder), {0, 2, -2}, {0, 0, 1}, 8);
  addLight(builder, {0, 2.5, -1.2}, {0, 0, -1}, 2);
  lookAtFloor(builder);
}

/// A mirror shows a plate the light that lies around it and below it.
void buildLSD(SceneBuilder& builder) {
  builder.square(white(builder), {0, 0, 0}, {0, 1, 0}, 2);
  builder.square(silver(builder), {0, 0.8, 0}, {0, -1, 0}, 6);
  addLight(builder, {0, -0.1, 0}, {0, 1, 0}, 4);
  builder.camera({0, 0.75, 0}, {0, 0, 0}, 1.6, kSize, kSize, {0, 0, 1});
}

/// A white box without a lid, 1 m high and 2 m wide.
void addOpenBox(SceneBuilder& builder, double x) {
  const uint wall = white(builder);
  builder.square(wall, {x, 0, 0}, {0, 1, 0}, 2);
  for (const double side : {-1.0, 1.0}) {
    builder.quad(wall, {x + side, 0, side}, {0, 0, -2 * side}, {0, 1, 0});
    builder.quad(wall, {x - side, 0, side}, {2 * side, 0, 0}, {0, 1, 0});
  }
}

/// The walls of a box light each other with what a mirror sends in, from lights beside its opening.
void buildLSDD(SceneBuilder& builder) {
  addOpenBox(builder, 0);
  builder.square(silver(builder), {0, 1.8, 0}, {0, -1, 0}, 6);
  for (const double side : {-1.7, 1.7}) addLight(builder, {side, 1, 0}, {0, 1, 0}, 1.3);
  builder.camera({0, 1.75, 0}, {0, 0, 0}, 0.8, kSize, kSize, {0, 0, 1});
}

/// Two halves of a floor, a wall between them, and a mirror above that shows one to the other, which the camera sees.
void buildLDSD(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(silver(builder), {0, 2, 0}, {0, -1, 0}, 12);
  builder.quad(black(builder), {0, 0, -6}, {0, 1.1, 0}, {0, 0, 12});
  addLight(builder, {-2.5, 1, 0}, {0, -1, 0}, 2);
  builder.camera({1.2, 1.5, 0}, {1, 0, 0.1}, 0.8, kSize, kSize);
}

/// The light shines down into a white box, and covers half of its opening. Through the other half a mirror shows the
/// box to a plate beside it, which the camera sees.
void buildLDDSD(SceneBuilder& builder) {
  addOpenBox(builder, -1);
  builder.square(white(builder), {1, 0.9, 0}, {0, 1, 0}, 1.8);
  builder.square(silver(builder), {0, 1.6, 0}, {0, -1, 0}, 8);
  builder.quad(builder.material(emitter(vec3(5.0f))), {-2, 0.99, -1}, {1, 0, 0}, {0, 0, 2});
  builder.camera({0.75, 1.5, 0.3}, {0.7, 0.9, 0}, 0.9, kSize, kSize);
}

void buildLDSE(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(silver(builder), {0, 1, -2}, {0, 0, 1}, 4);
  addLight(builder, {1.5, 2.5, 1}, {0, -1, 0}, 1);
  builder.camera({0, 2, 0.5}, {0, 1, -2}, 0.3, kSize, kSize);
}

void buildGlassBall(SceneBuilder& builder) {
  addFloor(builder);
  builder.icosphere(builder.material(glass(1.5f)), {0, 1, 0}, 0.7, 3, Facing::outside, Shading::smooth);
  addLight(builder, {0.3, 3, -0.4}, {0, -1, 0}, 3);
  builder.camera({0, 1.2, 4}, {0, 0.4, 0}, 0.4, kSize, kSize);
}

void addPane(SceneBuilder& builder, const Material& material) {
  addFloor(builder);
  builder.square(builder.material(material), {0, 2, 0}, {0, 1, 0}, 4);
  addLight(builder, {0.3, 2.5, 0}, {0, -1, 0}, 3);
  builder.camera({0, 1.9, 0}, {0, 0, 0}, 1.3, kSize, kSize, {0, 0, 1});
}

void buildThinPane(SceneBuilder& builder) { addPane(builder, thinGlass(1.5f)); }

void buildFrostedPane(SceneBuilder& builder) {
  Material frosted = thinGlass(1.5f);
  frosted.roughness = 0.5f;
  addPane(builder, frosted);
}

/// The light shines on a rough metal plate, and on a part of the floor; the camera sees what both reflect.
void buildGlossyPlate(SceneBuilder& builder) {
  addFloor(builder);
  builder.square(builder.material(metal(vec3(0.9f), 0.5f)), {0, 1.5, -2}, {0, -0.2, 1}, 4);
  addLight(builder, {0, 2.5, -0.6}, {0, -0.3, -1}, 2);
  builder.camera({0, 1.2, 3}, {0, 0.3, 0}, 0.9, kSize, kSize);
}

RenderJob photonJob(const PathClass& c, GatherSource gatherFrom) {
  RenderJob job = makeJob(Integrator::photon, 2);
  job.gather = c.gather;
  job.photons = 1u << c.log2Photons;
  job.gatherFrom = gatherFrom;
  if (gatherFrom == GatherSource::photons) job.constantDensity = c.density;
  return job;
}

/// Two one-sided tests at a significance of 0.01; numbers of samples are such that their power is above 0.99.
TEST_P(PathClasses, MapAndPathTracerAgree) {
  constexpr int kSeeds = 8;
  constexpr double kMargin = 0.02;
  SceneBuilder builder;
  GetParam().build(builder);
  const Scene scene = builder.finish();
  RenderJob path = makeJob(Integrator::path, 1);
  path.gather = GetParam().paths;
  const Moments traced = meanOverSeeds(path, scene, kSeeds);
  EXPECT_TRUE(areWithin(kMargin, meanOverSeeds(photonJob(GetParam(), GatherSource::cells), scene, kSeeds), traced))
      << "gathered from cells";
  if (!GetParam().hasGather) return;
  EXPECT_TRUE(areWithin(kMargin, meanOverSeeds(photonJob(GetParam(), GatherSource::photons), scene, kSeeds), traced))
      << "gathered from photons";
}

INSTANTIATE_TEST_SUITE_P(Of, PathClasses,
                         ::testing::Values(PathClass{"LD", buildLD, 64, 16, 12},
                                           PathClass{"LDD", buildLDD, 2048, 512, 14, true},
                                           PathClass{"LSD", buildLSD, 256, 16, 17},
                                           PathClass{"LSDD", buildLSDD, 1024, 128, 17, true, 20000},
                                           PathClass{"LDSD", buildLDSD, 3072, 768, 15, true},
                                           PathClass{"LDDSD", buildLDDSD, 3072, 512, 17, true, 20000},
                                           PathClass{"LDSE", buildLDSE, 512, 128, 13},
                                           PathClass{"GlassBall", buildGlassBall, 1024, 128, 16, true},
                                           PathClass{"ThinPane", buildThinPane, 512, 64, 15},
                                           PathClass{"FrostedPane", buildFrostedPane, 512, 64, 15},
                                           PathClass{"GlossyPlate", buildGlossyPlate, 1024, 256, 14, true}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace importon::test::path_class_test
