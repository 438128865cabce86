// What the camera sees where it sees no surface: the environment, a colour, or nothing with coverage as alpha.
#include <algorithm>
#include <array>

#include "render_helper.h"

namespace importon::test::background_test {
namespace {

constexpr int kSize = 16;

class Background : public RenderTest {};

/// A grey disc that leaves corners and edges of the image uncovered, in a uniform environment.
Scene discInSky(const Material& material) {
  SceneBuilder builder;
  builder.camera({0, 0, 3}, {0, 0, 0}, 0.8, kSize, kSize);
  builder.environment(vec3(0.5f, 1, 2));
  builder.disc(builder.material(material), {0.1, 0, 0}, {0, 0, 1}, 0.9, 40);
  return builder.finish();
}

RenderJob jobOf(Integrator integrator, PixelFilter filter) {
  RenderJob job = makeJob(integrator, 2);
  job.filter = filter;
  job.isAdaptive = false;  // so that all images are of the same paths
  return job;
}

/// Over white an image is RGB + (1 - A), and so in every pixel at edges, whatever the pixel filter.
TEST_F(Background, OfAColourIsTheTransparentImageOverIt) {
  const Scene scene = discInSky(diffuse(vec3(0.5f)));
  for (const Integrator integrator : {Integrator::photon, Integrator::path}) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackmanHarris}) {
      RenderJob job = jobOf(integrator, filter);
      job.isTransparent = true;
      const Image transparent = renderScene(job, scene).image;
      job.isTransparent = false;
      job.background = {1.0f, 1.0f, 1.0f};
      const Image white = renderScene(job, scene).image;
      const std::vector<float> alpha = valuesOf(transparent, "A");
      const auto isEdge = [](float a) { return a > 0.05f && a < 0.95f; };
      EXPECT_GT(std::ranges::count_if(alpha, isEdge), 10);
      EXPECT_EQ(std::ranges::count(alpha, 0.0f) > 0, true);
      for (const char* channel : {"R", "G", "B"}) {
        const std::vector<float> over = valuesOf(white, channel), own = valuesOf(transparent, channel);
        for (std::size_t i = 0; i < alpha.size(); ++i) ASSERT_NEAR(over[i], own[i] + (1 - alpha[i]), 1e-5) << i;
      }
    }
  }
}

/// A surface of uniform radiance L that is partly seen has RGB = A L. An emitter's is known.
TEST_F(Background, AlphaIsPremultipliedAtEdges) {
  RenderJob job = jobOf(Integrator::path, PixelFilter::gaussian);
  job.isTransparent = true;
  const Image image = renderScene(job, discInSky(emitter(vec3(3), false, vec3(0)))).image;
  const std::vector<float> alpha = valuesOf(image, "A"), red = valuesOf(image);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    EXPECT_NEAR(red[i], 3 * alpha[i], 1e-5) << i;
    EXPECT_TRUE(alpha[i] >= 0 && alpha[i] <= 1);
  }
}

/// The colour lights nothing, and the environment stays in what lies before it.
TEST_F(Background, LightsNothing) {
  const Scene scene = discInSky(diffuse(vec3(0.5f)));
  RenderJob job = jobOf(Integrator::path, PixelFilter::box);
  const Image sky = renderScene(job, scene).image;
  job.background = {0.0f, 100.0f, 0.0f};
  const Image green = renderScene(job, scene).image;
  EXPECT_EQ(sky.find("A"), nullptr);
  EXPECT_EQ(green.find("A"), nullptr);
  const Region middle{7, 7, 9, 9}, corner{0, 0, 1, 1};
  EXPECT_EQ(valuesOf(green, middle, "G"), valuesOf(sky, middle, "G"));
  EXPECT_EQ(valuesOf(green, corner, "G"), std::vector<float>{100});
  EXPECT_EQ(valuesOf(sky, corner, "G"), std::vector<float>{1});
}

/// A scene that no environment lights has a background too.
TEST_F(Background, IsSeenWithoutAnEnvironment) {
  SceneBuilder builder;
  builder.camera({0, 0, 3}, {0, 0, 0}, 0.8, kSize, kSize);
  builder.disc(builder.material(emitter(vec3(3), false, vec3(0))), {0, 0, 0}, {0, 0, 1}, 0.5, 40);
  RenderJob job = jobOf(Integrator::photon, PixelFilter::box);
  job.background = {0.25f, 0.5f, 0.75f};
  EXPECT_EQ(valuesOf(renderScene(job, builder.finish()).image, {0, 0, 1, 1}, "B"), std::vector<float>{0.75f});
}

/// What mirrors and glass show is the environment, and counts as covered.
TEST_F(Background, IsNotSeenThroughGlass) {
  Material clear = glass(1);
  const Scene scene = discInSky(clear);
  RenderJob job = jobOf(Integrator::path, PixelFilter::box);
  const Image sky = renderScene(job, scene).image;
  job.isTransparent = true;
  const Image image = renderScene(job, scene).image;
  const Region middle{7, 7, 9, 9};
  EXPECT_EQ(valuesOf(image, middle, "A"), std::vector<float>(4, 1));
  EXPECT_EQ(valuesOf(image, middle, "B"), valuesOf(sky, middle, "B"));
  EXPECT_GT(valuesOf(image, middle, "B")[0], 1);
}

}  // namespace
}  // namespace importon::test::background_test
