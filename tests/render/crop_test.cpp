// A part of the image: it is what the whole image shows there, and importance comes from there alone.
#include "io/image_part.h"
#include "render_helper.h"

namespace importon::test::crop_test {
namespace {

constexpr int kSize = 32;
constexpr importon::Crop kCrop{18, 3, 9, 12};

/// Named after what it tests, which it hides here.
class Crop : public RenderTest {};

/// A room with a lamp, a mirror ball and a window to a bright sky.
Scene room() {
  SceneBuilder builder;
  const uint wall = builder.material(diffuse(vec3(0.6f, 0.5f, 0.4f)));
  builder.quad(wall, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2});
  builder.quad(wall, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  builder.quad(wall, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0});
  builder.icosphere(builder.material(mirror(vec3(0.9f))), {0.4, -0.6, -0.2}, 0.35, 2, Facing::outside, Shading::smooth);
  builder.square(builder.material(emitter(vec3(8))), {0.2, 0.98, 0}, {0, -1, 0}, 0.4);
  builder.environment(vec3(0.1f));
  builder.camera({0.1, 0.1, 2.6}, {0, 0, 0}, 0.8, kSize, kSize);
  return builder.finish();
}

Image partOf(const Image& image) { return cutOut(image, kCrop.x, kCrop.y, kCrop.width, kCrop.height).value(); }

RenderJob cropped(RenderJob job) {
  job.crop = kCrop;
  return job;
}

TEST_F(Crop, ShowsTheSameBitsAsThePart) {
  const Scene scene = room();
  for (const PixelFilter filter : {PixelFilter::box, PixelFilter::gaussian}) {
    RenderJob job = makeJob(Integrator::path, 3, 5);
    job.gather = 3;
    job.filter = filter;
    job.isTransparent = true;
    job.aovs = {"albedo", "N", "P", "depth", "direct", "caustic", "indirect", "emission", "variance"};
    const Image whole = renderScene(job, scene).image, part = renderScene(cropped(job), scene).image;
    EXPECT_TRUE(haveSameBits(part, partOf(whole)));
    EXPECT_FALSE(haveSameBits(part, cutOut(whole, 0, 0, kCrop.width, kCrop.height).value()));
    EXPECT_EQ(part.whole.width, kSize);
    EXPECT_EQ(part.whole.height, kSize);
    EXPECT_EQ(part.whole.x, kCrop.x);
    EXPECT_EQ(part.whole.y, kCrop.y);
    EXPECT_EQ(whole.whole.width, 0) << "all of an image is no part";
  }
}

/// Sums of many paths are rounded by chance, each pixel's by its own.
TEST_F(Crop, ShowsTheSameBitsAfterManyPaths) {
  const Scene scene = room();
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 520;  // 4096 paths make a sum long, and a pixel may have up to 8 times as many
  job.maxDepth = 1;
  const Image whole = renderScene(job, scene).image, part = renderScene(cropped(job), scene).image;
  EXPECT_TRUE(haveSameBits(part, partOf(whole)));
}

/// Of all of the image it is no other image.
TEST_F(Crop, OfAllKeepsTheBits) {
  const Scene scene = room();
  RenderJob job = makeJob(Integrator::photon, 2);
  const Image whole = renderScene(job, scene).image;
  job.crop = importon::Crop{0, 0, kSize, kSize};
  EXPECT_TRUE(haveSameBits(renderScene(job, scene).image, whole));
}

/// Significance 0.01 that the two are within 2 %.
TEST_F(Crop, OfThePhotonMapHasTheMeanOfThatPart) {
  const Scene scene = room();
  RenderJob paths = makeJob(Integrator::path, 1);
  paths.gather = 512;
  RenderJob photons = makeJob(Integrator::photon, 4);
  photons.gather = 16;
  const Moments reference = meanOverSeeds(cropped(paths), scene, 8);
  EXPECT_TRUE(areWithin(0.02, meanOverSeeds(cropped(photons), scene, 14), reference));
}

/// At the same photons shot: places that only other parts of the image ask for keep few.
TEST_F(Crop, StoresFewerPhotons) {
  const Scene scene = room();
  RenderJob job = makeJob(Integrator::photon, 1);
  job.gatherFrom = GatherSource::photons;
  job.emission = EmissionChoice::power;
  job.photons = 1u << 18;
  job.globalDensity = 3000;  // well above the least required density
  const RenderStats whole = renderScene(job, scene).stats, part = renderScene(cropped(job), scene).stats;
  EXPECT_EQ(part.photonsEmitted, whole.photonsEmitted);
  EXPECT_LT(static_cast<double>(part.global.stored), 0.8 * static_cast<double>(whole.global.stored));
}

}  // namespace
}  // namespace importon::test::crop_test
