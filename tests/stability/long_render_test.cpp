// Renders of a day: the pass counter jumps to where so many passes would have led.
#include <cmath>
#include <cstring>

#include "hard_scenes.h"
#include "render/renderer.h"
#include "render_helper.h"

namespace importon::test::long_render_test {
namespace {

constexpr int kSize = 12;

class LongRenders : public RenderTest {
 protected:
  Log log_{Log::Verbosity::quiet};

  static void renderPasses(Renderer& renderer, int first, int count) {
    for (int pass = first; pass < first + count; ++pass) renderer.renderPass(pass, kPartsOfPass);
  }

  /// What `passes` passes, taken as an even number, come to.
  static PassSums sumsOf(const RenderJob& job, std::uint64_t passes) {
    PassSums sums;
    sums.evenSamples = sums.oddSamples = passes / 2 * static_cast<std::uint64_t>(job.gather.value_or(4));
    sums.caustic.shot = sums.global.shot = passes * job.photons.value_or(0);
    return sums;
  }

  /// Values of the image of `count` passes, an even number, from pass `first` on. The film does not hold those before.
  std::vector<float> passesFrom(int first, int count, const RenderJob& job, const Scene& scene) {
    Renderer renderer(job, scene, log_);
    renderer.prepare();
    renderer.done() = sumsOf(job, static_cast<std::uint64_t>(first));
    renderPasses(renderer, first, count);
    std::vector<float> values = valuesOf(renderer.image(renderer.resolve(renderer.film())));
    const int passes = first / 2 * 2 + count;
    for (float& value : values) value *= static_cast<float>(passes) / static_cast<float>(count);
    return values;
  }
};

std::vector<FilmPixel> filmOf(const Checkpoint& checkpoint) {
  const std::vector<std::byte>& bytes = checkpoint.find("film 0")->bytes;
  std::vector<FilmPixel> film(bytes.size() / sizeof(FilmPixel));
  std::memcpy(static_cast<void*>(film.data()), bytes.data(), bytes.size());
  return film;
}

/// As if each pass had been done 2^exponent times.
Checkpoint repeated(Checkpoint checkpoint, int exponent) {
  for (CheckpointBlock& block : checkpoint.blocks) {
    if (block.name != "film 0") continue;
    std::vector<float> values(block.bytes.size() / sizeof(float));
    std::memcpy(values.data(), block.bytes.data(), block.bytes.size());
    for (float& value : values) value = std::ldexp(value, exponent);
    std::memcpy(block.bytes.data(), values.data(), block.bytes.size());
  }
  checkpoint.passes <<= exponent;
  return checkpoint;
}

/// A radiance of 0.1 is 6.4 units in the last place of such sums.
TEST_F(LongRenders, SumsOfAMillionPassesGoOnToGrow) {
  const StabilityCase listed(53, "the film after 2^20 passes of 4 samples", "further passes add their light");
  SceneBuilder builder;
  builder.square(builder.material(emitter(vec3(0.1f))), {0, 0, 0}, {0, 0, 1}, 4);
  builder.camera({0, 0, 1}, {0, 0, 0}, 0.8, kSize, kSize);
  const Scene scene = builder.finish();
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 4;
  Renderer renderer(job, scene, log_);
  renderPasses(renderer, 0, 2);
  const Checkpoint before = repeated({0, 2, blocksOf(renderer.state())}, 19);
  restore(renderer.state(), before, "memory");
  renderer.done() = sumsOf(job, static_cast<std::uint64_t>(before.passes));
  constexpr int kMore = 32;
  renderPasses(renderer, before.passes, kMore);
  const std::vector<FilmPixel> old = filmOf(before),
                               grown = filmOf({0, before.passes + kMore, blocksOf(renderer.state())});
  Moments added;
  for (std::size_t i = 0; i < old.size(); ++i)
    for (int c = 0; c < 3; ++c)
      added.add(static_cast<double>(grown[i].emitted[c]) - static_cast<double>(old[i].emitted[c]));
  EXPECT_TRUE(isWithin(0.01, added, static_cast<double>(0.1f) * 4 * kMore / 2));
  EXPECT_TRUE(isConstant(renderer.image(renderer.resolve(renderer.film())), 0.1, 1e-5));
}

Scene litRoom(int size) {
  SceneBuilder builder;
  builder.box(builder.material(diffuse(vec3(0.6f))), {-1, -1, -1}, {1, 1, 1}, Facing::inside);
  builder.square(builder.material(emitter(vec3(3.0f))), {0, 0.9, 0}, {0, -1, 0}, 0.6);
  builder.camera({0.1, 0.2, 0.9}, {-0.1, -0.3, -1}, 1.3, size, size);
  return builder.finish();
}

/// 2^32 photons, or paths of a pixel, later.
TEST_F(LongRenders, RandomNumbersDoNotComeAgain) {
  const StabilityCase listed(54, "2^32 photons, or paths of a pixel, later", "other random numbers, the same mean");
  const Scene scene = litRoom(4);
  RenderJob paths = makeJob(Integrator::path, 1);
  paths.gather = 1 << 11;
  const std::vector<float> first = passesFrom(0, 2, paths, scene);
  const std::vector<float> later = passesFrom(1 << 21, 2, paths, scene);
  Moments differences;
  for (std::size_t i = 0; i < first.size(); ++i) differences.add(static_cast<double>(later[i] - first[i]));
  EXPECT_GT(differences.variance(), 0);
  const std::vector<double> a(first.begin(), first.end()), b(later.begin(), later.end());
  EXPECT_TRUE(isWithin(0.05, ratiosOf(b, a), 1));
  const RenderJob photons = makeJob(Integrator::photon, 1);
  Renderer renderer(photons, scene, log_);
  renderer.prepare();
  std::uint64_t counted = 0;
  const auto hitsOf = [&](int pass) {
    renderer.done() = sumsOf(photons, static_cast<std::uint64_t>(pass));
    renderer.renderPass(pass, kPartsOfPass);
    const std::uint64_t hits = renderer.stats().global.hits - counted;
    counted = renderer.stats().global.hits;
    return hits;
  };
  EXPECT_NE(hitsOf(0), hitsOf(1 << 19));
}

/// A photon of the weak light is less than a hundredth of a unit of the cells' power by then.
TEST_F(LongRenders, SlowCellsKeepTheWeakestLight) {
  const StabilityCase listed(55, "light 1e-8 as strong as a hidden one, after 2^18 passes",
                             "the same mean as at the start");
  const Scene scene = sphereBesideStrongLight(kSize);
  RenderJob job = makeJob(Integrator::photon, 2);
  Moments early, late;
  for (job.seed = 1; job.seed <= 8; ++job.seed) {
    early.add(momentsOf(passesFrom(0, 2, job, scene)).mean());
    late.add(momentsOf(passesFrom((1 << 18) - 1, 2, job, scene)).mean());
  }
  EXPECT_TRUE(haveSameMean(early, late));
}

}  // namespace
}  // namespace importon::test::long_render_test
