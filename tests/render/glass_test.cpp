// Smooth surfaces in closed form: sheets, slabs, prisms and mirrors.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render_helper.h"

namespace importon::test::glass_test {
namespace {

constexpr int kSize = 16;

class Smooth : public RenderTest, public ::testing::WithParamInterface<Integrator> {
 protected:
  [[nodiscard]] Image renderImage(const Scene& scene, int paths) const {
    RenderJob job = makeJob(GetParam(), 1);
    job.gather = paths;  // per pixel
    return renderScene(job, scene).image;
  }
};

class Window : public RenderTest {};

/// An emitter of radiance 1, across the whole view of a camera with a narrow field.
SceneBuilder brightWall() {
  SceneBuilder builder;
  builder.square(builder.material(emitter(vec3(1.0f))), {0, 0, -2}, {0, 0, 1}, 4);
  builder.camera({0, 0, 2}, {0, 0, 0}, 0.02, kSize, kSize);
  return builder;
}

/// Share of light that a sheet of index 1.5 passes at normal incidence, all inner reflections counted:
/// (1 - R) / (1 + R) with R = ((n - 1) / (n + 1))².
constexpr double kSlabTransmittance = (1 - 0.04) / (1 + 0.04);

TEST_P(Smooth, ThinSheetPassesWhatFresnelLeaves) {
  SceneBuilder builder = brightWall();
  builder.square(builder.material(thinGlass(1.5f)), {0, 0, 0}, {0, 0, 1}, 4);
  EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 16))), kSlabTransmittance));
}

TEST_P(Smooth, SolidSlabPassesWhatFresnelLeaves) {
  StabilityCase listed(15, "a slab of index 1.5, looked through", "0.923 of what is behind");
  SceneBuilder builder = brightWall();
  builder.box(builder.material(glass(1.5f)), {-2, -2, -0.5}, {2, 2, 0.5}, Facing::outside);
  EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 32))), kSlabTransmittance));
  listed.note("within the test's rounding", 1);
}

/// Beer's law over the slab's thickness, with each of the reflections inside it.
TEST_P(Smooth, SolidSlabAbsorbsByItsThickness) {
  constexpr double kPerMetre = 0.4, kThickness = 2.5, kReflectance = 0.04;
  SceneBuilder builder = brightWall();
  builder.box(builder.material(glass(1.5f, vec3(static_cast<float>(kPerMetre)))), {-2, -2, -1.5}, {2, 2, 1},
              Facing::outside);
  const double through = std::exp(-kPerMetre * kThickness), there = kReflectance * through;
  EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 64))),
                       (1 - kReflectance) * (1 - kReflectance) * through / (1 - there * there)));
}

/// Share of light that passes a sheet of this optical thickness at a cosine, and all its inner reflections: by the way
/// inside, which Snell's law bends, and twice Fresnel's formula for unpolarised light.
double sheetTransmittance(double depth, double cosine, double ior = 1.5) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
  const double across = (cosine - ior * inside) / (cosine + ior * inside);
  const double along = (ior * cosine - inside) / (ior * cosine + inside);
  const double reflectance = (across * across + along * along) / 2;
  const double through = std::exp(-depth / inside), there = reflectance * through;
  return (1 - reflectance) * (1 - reflectance) * through / (1 - there * there);
}

Material absorbingSheet(float thickness, const vec3& absorption) {
  Material material = thinGlass(1.5f);
  material.thickness = thickness;
  material.absorption = absorption;
  return material;
}

TEST_P(Smooth, SheetsAbsorbByTheirThicknessAndTheWayThroughIt) {
  const vec3 absorption(0.5f, 4, 0);
  for (const double angle : {0.0, 1.0}) {
    SceneBuilder builder = brightWall();
    builder.square(builder.material(absorbingSheet(0.3f, absorption)), {0, 0, 0}, {std::sin(angle), 0, std::cos(angle)},
                   4);
    const Image image = renderImage(builder.finish(), 256);
    for (int c = 0; c < 3; ++c)
      EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(image, std::string(1, "RGB"[c]))),
                           sheetTransmittance(0.3 * static_cast<double>(absorption[c]), std::cos(angle))))
          << c << ' ' << angle;
  }
}

/// Sunlight through a window of one plane onto a wall behind it, and back to the camera.
TEST_F(Window, OfOnePlaneColorsTheLightThatItLetsIn) {
  const vec3 absorption(16, 2, 0);
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(0.05f))), {0, 0, -2}, {0, 0, 1}, 4);
  builder.square(builder.material(absorbingSheet(0.1f, absorption)), {0, 0, 0}, {0, 0, 1}, 6);
  builder.directionalLight({0, 0, -1}, vec3(glm::pi<float>()));
  builder.camera({0, 0, 2}, {0, 0, 0}, 0.2, kSize, kSize);
  RenderJob job = makeJob(Integrator::photon, 1);
  job.photons = 1u << 16;
  const auto light = overSeeds(job, builder.finish(), 8, [](const Rendered& r) {
    return std::vector<double>{meanOf(r.image, "R"), meanOf(r.image, "G"), meanOf(r.image, "B")};
  });
  for (int c = 0; c < 3; ++c) {
    const double once = sheetTransmittance(0.1 * static_cast<double>(absorption[c]), 1);
    EXPECT_TRUE(isWithin(0.03, light[static_cast<std::size_t>(c)], 0.05 * once * once)) << c;
  }
}

/// Share of light that passes a row of interfaces with these relative indices at normal incidence, all inner
/// reflections counted: what they turn back, (1 - T) / T, adds up.
double rowTransmittance(const std::vector<double>& relativeIndices) {
  double turnedBack = 0;
  for (const double n : relativeIndices) {
    const double reflectance = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    turnedBack += reflectance / (1 - reflectance);
  }
  return 1 / (1 + turnedBack);
}

TEST_P(Smooth, SolidInSolidRefractsByTheRelativeIndex) {
  for (const float inner : {2.0f, 1.5f, 1.0f}) {
    SceneBuilder builder = brightWall();
    builder.box(builder.material(glass(1.5f)), {-2, -2, -0.5}, {2, 2, 0.5}, Facing::outside);
    builder.box(builder.material(glass(inner)), {-1, -1, -0.2}, {1, 1, 0.2}, Facing::outside);
    const double relative = static_cast<double>(inner) / 1.5;
    EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 32))),
                         rowTransmittance({1.5, relative, relative, 1.5})))
        << inner;
  }
}

/// What is around a solid is known again after it was left.
TEST_P(Smooth, SolidsBehindEachOtherInASolidRefractAlike) {
  SceneBuilder builder = brightWall();
  builder.box(builder.material(glass(1.5f)), {-2, -2, -0.5}, {2, 2, 0.5}, Facing::outside);
  for (const double z : {-0.4, 0.1})
    builder.box(builder.material(glass(2.25f)), {-1, -1, z}, {1, 1, z + 0.3}, Facing::outside);
  EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 256))),
                       rowTransmittance({1.5, 1.5, 1.5, 1.5, 1.5, 1.5})));
}

/// Box in box in box, each of its own index, looked through along all their axes.
SceneBuilder nestedBoxes(std::initializer_list<double> indices) {
  SceneBuilder builder = brightWall();
  double size = 2;
  for (const double index : indices) {
    const glm::dvec3 half(size, size, 0.4 * size);
    builder.box(builder.material(glass(static_cast<float>(index))), -half, half, Facing::outside);
    size *= 0.8;
  }
  return builder;
}

TEST_P(Smooth, EachOfManyNestedSolidsKnowsWhatIsAroundIt) {
  for (const auto& indices : {std::initializer_list<double>{1.5, 1.33, 1.31},
                              std::initializer_list<double>{1.3, 1.2, 1.3, 1.2, 1.3, 1.2, 1.3, 1.2}}) {
    std::vector<double> relative;
    double around = 1;
    for (const double index : indices) {
      relative.push_back(index / around);
      relative.push_back(index / around);  // and out again
      around = index;
    }
    EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(nestedBoxes(indices).finish(), 256))),
                         rowTransmittance(relative)));
  }
}

TEST_P(Smooth, SolidsInMoreSolidsThanAPathCanKnowAreSaid) {
  RenderJob job = makeJob(GetParam(), 1);
  const auto isSaid = [&](std::initializer_list<double> indices) {
    const std::vector<Warning> warnings = renderScene(job, nestedBoxes(indices).finish()).warnings;
    return std::ranges::any_of(warnings, [](const Warning& w) { return w.kind == "solids in solids"; });
  };
  EXPECT_FALSE(isSaid({1.1, 1.2, 1.1, 1.2, 1.1, 1.2, 1.1, 1.2}));
  EXPECT_TRUE(isSaid({1.1, 1.2, 1.1, 1.2, 1.1, 1.2, 1.1, 1.2, 1.1}));
}

TEST_P(Smooth, MoreMediaThanThereAreNumbersForAreSaid) {
  RenderJob job = makeJob(GetParam(), 1);
  for (const int count : {255, 256}) {
    SceneBuilder builder = brightWall();
    for (int i = 0; i < count; ++i) {
      const double x = 3 + 2 * i;
      const uint material = builder.material(glass(1.5f + 0.001f * static_cast<float>(i)));
      builder.box(material, {x, 0, 0}, {x + 1, 1, 1}, Facing::outside);
    }
    const std::vector<Warning> warnings = renderScene(job, builder.finish()).warnings;
    EXPECT_EQ(std::ranges::count_if(warnings, [](const Warning& w) { return w.kind == "many media"; }), count / 256);
  }
}

TEST_P(Smooth, OverlappingSolidsMeetInOneInterface) {
  SceneBuilder builder = brightWall();
  builder.box(builder.material(glass(1.5f)), {-2, -2, -0.5}, {2, 2, 0.1}, Facing::outside);
  builder.box(builder.material(glass(2.0f)), {-2, -2, 0}, {2, 2, 0.6}, Facing::outside);
  EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 32))), rowTransmittance({2, 0.75, 1.5})));
}

/// From within the solid radiance is larger by the squared index; Beer's law takes its share.
TEST_P(Smooth, CameraInsideGlassSeesThroughIt) {
  StabilityCase listed(41, "camera inside glass", "the right medium");
  SceneBuilder builder;
  builder.square(builder.material(emitter(vec3(1.0f))), {0, 0, -2}, {0, 0, 1}, 4);
  const double perMetre = 0.7;
  builder.box(builder.material(glass(1.5f, vec3(static_cast<float>(perMetre)))), {-2, -2, -0.5}, {2, 2, 3},
              Facing::outside);
  builder.camera({0, 0, 1}, {0, 0, 0}, 0.02, kSize, kSize);
  // Once through to the wall; of what it turns back, the far wall sends 0.04 through the solid again.
  constexpr double kSquare = 1.5 * 1.5;
  const double once = std::exp(-1.5 * perMetre), there = 0.04 * std::exp(-3.5 * perMetre);
  const double expected = kSquare * 0.96 * once / (1 - there * there);
  EXPECT_TRUE(isWithin(0.02, momentsOf(valuesOf(renderImage(builder.finish(), 32))), expected));
  listed.note("as the closed form", 1);
}

/// A right-angled prism: the camera looks through one leg at the hypotenuse, behind which all is bright.
Scene prismBeforeLight(float ior) {
  SceneBuilder builder = brightWall();
  const uint prism = builder.material(glass(ior));
  const glm::dvec3 a(-1, 0, 1), b(1, 0, 1), c(-1, 0, -1), up(0, 2, 0), low(0, -1, 0);
  builder.quad(prism, a + low, b - a, up);  // leg towards the camera
  builder.quad(prism, b + low, c - b, up);  // hypotenuse
  builder.quad(prism, c + low, a - c, up);  // other leg
  builder.triangle(prism, a + low, c + low, b + low);
  builder.triangle(prism, a - low, b - low, c - low);
  return builder.finish();
}

TEST_P(Smooth, PrismReflectsTotallyBeyondTheCriticalAngle) {
  StabilityCase listed(16, "a prism at 45 degrees", "0 through the face that reflects totally");
  const Image dark = renderImage(prismBeforeLight(1.5f), 16);
  for (const float value : valuesOf(dark)) ASSERT_EQ(value, 0.0f);
  listed.note("0", 1);
}

TEST_P(Smooth, PrismPassesLightBelowTheCriticalAngle) {
  EXPECT_GT(meanOf(renderImage(prismBeforeLight(1.3f), 16)), 0.5);
}

/// A floor, grey and red, under a point light that no glass covers; all light is direct.
SceneBuilder litFloor() {
  SceneBuilder builder;
  builder.quad(builder.material(diffuse(vec3(0.6f))), {-10, 0, -10}, {0, 0, 20}, {10, 0, 0});
  builder.quad(builder.material(diffuse(vec3(0.6f, 0.1f, 0.1f))), {0, 0, -10}, {0, 0, 20}, {10, 0, 0});
  builder.pointLight({-2, 1, 0}, vec3(5.0f));
  builder.camera({0, 3, 2}, {0, 0, 0}, 0.7, kSize, kSize);
  return builder;
}

TEST_P(Smooth, GlassOfIndexOneIsInvisible) {
  StabilityCase listed(14, "glass of index 1", "the image without it");
  const Image without = renderImage(litFloor().finish(), 4);
  for (const bool isThin : {true, false}) {
    SceneBuilder builder = litFloor();
    const uint pane = builder.material(isThin ? thinGlass(1.0f) : glass(1.0f));
    if (isThin)
      builder.square(pane, {0, 2.4, 1.6}, {0, 3, 2}, 1.2);
    else
      builder.icosphere(pane, {0, 2.4, 1.6}, 0.4, 2, Facing::outside, Shading::flat);
    const Image with = renderImage(builder.finish(), 4);
    for (const char* channel : {"R", "G", "B"}) {
      const std::vector<float> a = valuesOf(without, channel), b = valuesOf(with, channel);
      for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-4f * a[i]) << i;  // float rounding
    }
  }
  listed.note("as without it", 1);
}

/// Luminous squares before the camera; or, if `isMirrored`, their mirror images in z = 0 behind a mirror there.
Scene luminousSquares(bool isMirrored) {
  SceneBuilder builder;
  const double side = isMirrored ? 1 : -1;
  const vec3 colors[] = {{1, 0.2f, 0.1f}, {0.1f, 2, 0.3f}, {0.3f, 0.1f, 0.7f}};
  const glm::dvec3 places[] = {{-0.7, 0.3, 1.1}, {0.5, -0.4, 1.7}, {0.1, 0.6, 2.3}};
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 place(places[i].x, places[i].y, side * places[i].z);
    builder.square(builder.material(emitter(colors[i])), place, {0, 0, -side}, 0.8);
  }
  if (isMirrored) builder.square(builder.material(mirror()), {0, 0, 0}, {0, 0, 1}, 40);
  builder.camera({0.05, 0.1, 0.9}, {0, 0, 0}, 1.2, kSize, kSize);
  return builder.finish();
}

TEST_P(Smooth, MirrorShowsTheVirtualImage) {
  StabilityCase listed(33, "a mirror plane", "the virtual image");
  const Image object = renderImage(luminousSquares(false), 4), image = renderImage(luminousSquares(true), 4);
  EXPECT_GT(meanOf(object), 0.05);
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float> a = valuesOf(object, channel), b = valuesOf(image, channel);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-5f) << i;  // float rounding
  }
  listed.note("off by less than 1e-5", 1);
}

INSTANTIATE_TEST_SUITE_P(Both, Smooth, ::testing::Values(Integrator::path, Integrator::photon),
                         [](const auto& test) { return test.param == Integrator::path ? "Path" : "Photon"; });

class Caustic : public RenderTest {};

TEST_F(Caustic, OfParallelLightThroughSlabIsItsTransmittance) {
  const StabilityCase listed(15, "parallel light through a slab onto a floor", "0.923 of it");
  SceneBuilder builder;
  builder.square(builder.material(diffuse(vec3(1.0f))), {0, 0, 0}, {0, 1, 0}, 4);
  builder.box(builder.material(glass(1.5f)), {-2.5, 1, -2.5}, {2.5, 1.2, 2.5}, Facing::outside);
  builder.directionalLight({0, -1, 0}, vec3(3.0f));
  builder.camera({0, 0.8, 0}, {0, 0, 0}, 1.0, kSize, kSize, {0, 0, 1});
  RenderJob job = makeJob(Integrator::photon, 2);
  job.photons = 1u << 16;
  job.aovs = {"caustic"};  // without what the floor sends back and the slab returns
  const auto caustic = [](const Rendered& r) { return std::vector{meanOf(r.image, "caustic.R")}; };
  const Moments found = overSeeds(job, builder.finish(), 6, caustic).front();
  EXPECT_TRUE(isWithin(0.01, found, 3 * kSlabTransmittance / glm::pi<double>()));
}

}  // namespace
}  // namespace importon::test::glass_test
