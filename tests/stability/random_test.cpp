// Renders that nobody would ask for: random triangles, materials, lights and cameras over twelve orders of magnitude,
// with random settings.
#include <cmath>
#include <cstdlib>
#include <random>

#include "render_helper.h"

namespace importon::test {
namespace {

/// For a long search: IMPORTON_RANDOM_SCENES, how many, and IMPORTON_RANDOM_FIRST, the first seed.
unsigned fromEnvironment(const char* name, unsigned otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : static_cast<unsigned>(std::atoi(text));
}

/// Draws from a seed.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

 protected:
  double unit() { return std::uniform_real_distribution<double>()(random_); }
  int below(int limit) { return static_cast<int>(unit() * limit); }
  bool oneIn(int count) { return below(count) == 0; }
  double magnitude(double low, double high) { return std::pow(10.0, low + (high - low) * unit()); }
  glm::dvec3 point() { return glm::dvec3(unit(), unit(), unit()) * 2.0 - 1.0; }
  glm::dvec3 direction() { return glm::normalize(point() + glm::dvec3(0, 1e-3, 0)); }
  vec3 color() { return vec3(unit(), unit(), unit()); }
  template <class Value>
  Value anyOf(std::initializer_list<Value> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }

 private:
  std::mt19937 random_;
};

class RandomScene : Dice {
 public:
  using Dice::Dice;

  Scene make() {
    scale_ = magnitude(-6, 6);
    const int materials = 1 + below(6), shapes = 1 + below(12), lights = 1 + below(5);
    for (int i = 0; i < materials; ++i) builder_.material(anyMaterial());
    for (int i = 0; i < shapes; ++i) addShape(static_cast<uint>(below(materials)));
    for (int i = 0; i < lights; ++i) addLight();
    const glm::dvec3 eye = scale_ * point();
    builder_.camera(eye, eye + scale_ * direction(), 0.01 + 3.0 * unit(), 4 + below(8), 4 + below(8));
    Scene scene = builder_.finish();
    if (oneIn(4)) addTexture(scene);
    return scene;
  }

 private:
  Material anyMaterial() {
    Material m = diffuse(color());
    m.specular = static_cast<float>(below(2));
    m.metallic = oneIn(3) ? 1.0f : 0.0f;
    m.roughness = oneIn(2) ? 0.0f : static_cast<float>(unit());
    m.transmission = oneIn(3) ? 1.0f : 0.0f;
    m.ior = static_cast<float>(1 + 2 * unit());
    m.clearcoat = oneIn(4) ? static_cast<float>(unit()) : 0.0f;
    m.clearcoatRoughness = static_cast<float>(unit());
    m.absorption = oneIn(4) ? color() * static_cast<float>(magnitude(-6, 6)) : vec3(0.0f);
    m.specularColor = oneIn(4) ? color() : vec3(1.0f);
    m.flags =
        (oneIn(2) ? kMaterialDoubleSided : 0u) | (oneIn(2) ? kMaterialSolid : 0u) | (oneIn(12) ? kMaterialUnlit : 0u);
    if (oneIn(6)) {
      m.flags |= oneIn(2) ? kMaterialAlphaMask : kMaterialAlphaBlend;
      m.baseColor.a = static_cast<float>(unit());
      m.alphaCutoff = static_cast<float>(unit());
    }
    if (oneIn(4)) {
      m.emission = color() * static_cast<float>(magnitude(-6, 6));
      m.flags |= kMaterialEmissive;
    }
    return m;
  }

  void addShape(uint material) {
    const glm::dvec3 centre = scale_ * point();
    const double size = scale_ * magnitude(-4, 0);
    switch (below(4)) {
      case 0:
        return builder_.triangle(material, centre, centre + size * point(), centre + scale_ * point());
      case 1:
        return builder_.square(material, centre, direction(), size, 1 + below(4));
      case 2:
        return builder_.box(material, centre - size, centre + size, oneIn(2) ? Facing::inside : Facing::outside);
      default:
        return builder_.icosphere(material, centre, size, below(3), oneIn(2) ? Facing::inside : Facing::outside,
                                  Shading::smooth);
    }
  }

  void addLight() {
    const vec3 intensity = color() * static_cast<float>(magnitude(-6, 6));
    switch (below(4)) {
      case 0:
        return builder_.pointLight(scale_ * point(), intensity);
      case 1:
        return builder_.spotLight(scale_ * point(), direction(), intensity, 0.2 * unit(), 0.21 + unit());
      case 2:
        return builder_.directionalLight(direction(), intensity);
      default:
        return builder_.environment(intensity);
    }
  }

  /// Noise of 4 x 4 texels, as colour, roughness and metalness, emission, transmission and coat of some materials.
  void addTexture(Scene& scene) {
    Texture texture{};
    texture.firstTexel = static_cast<uint>(scene.texels.size());
    texture.width = texture.height = 4;
    texture.wrapS = texture.wrapT = static_cast<uint>(below(3));
    texture.isNearest = oneIn(2) ? 1 : 0;
    texture.isSrgb = oneIn(2) ? 1 : 0;
    const auto scale = static_cast<float>(magnitude(-6, 6));
    texture.uvRow0 = vec3(scale, -scale, unit());
    texture.uvRow1 = vec3(scale, scale, unit());
    for (int i = 0; i < 16; ++i) scene.texels.push_back(static_cast<uint>(unit() * 0x1p32));
    scene.textures.push_back(texture);
    const auto last = static_cast<uint>(scene.textures.size() - 1);
    for (Material& m : scene.materials)
      for (uint* const use : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture,
                              &m.transmissionTexture, &m.specularTexture, &m.clearcoatTexture})
        if (oneIn(3)) *use = last;
  }

  SceneBuilder builder_;
  double scale_ = 1;
};

/// Compiling kernels costs a hundred times what a tiny render does: so many seeds in a row share theirs.
constexpr unsigned kScenesOfAProgram = 64;

/// What the kernels depend on, by chance.
class RandomProgram : Dice {
 public:
  using Dice::Dice;

  RenderJob make() {
    RenderJob job = makeJob(oneIn(5) ? Integrator::path : Integrator::photon, 2);
    job.filter = anyOf({PixelFilter::box, PixelFilter::gaussian, PixelFilter::blackmanHarris});
    job.importance = anyOf({ImportanceChoice::map, ImportanceChoice::differentials});
    job.differentialBound = anyOf({DifferentialBound::pixel, DifferentialBound::screen});
    job.gatherFrom = anyOf({GatherSource::photons, GatherSource::cells});
    if (job.importance == ImportanceChoice::differentials) job.gatherFrom = GatherSource::photons;
    job.scatter = anyOf({ScatterChoice::material, ScatterChoice::guided});
    job.requiredBy = anyOf({RequiredBy::importance, RequiredBy::contribution, RequiredBy::direction});
    job.forcesAllFeatures = true;
    return job;
  }
};

/// A job of two passes and few photons with settings by chance. One in kScenesOfAProgram has its own kernels, with the
/// features that its scene has.
class RandomJob : Dice {
 public:
  explicit RandomJob(unsigned seed) : Dice(~seed), seed_(seed) {}

  RenderJob make() {
    RenderJob job = RandomProgram(~(seed_ / kScenesOfAProgram)).make();
    job.forcesAllFeatures = seed_ % kScenesOfAProgram != 0;
    job.seed = static_cast<std::uint32_t>(below(1000));
    if (job.integrator == Integrator::photon) job.photons = 1u << below(12);
    if (oneIn(2)) setDensity(job);
    if (oneIn(2)) setPhotons(job);
    if (oneIn(3)) job.gather = 1 + below(4);
    if (oneIn(3)) job.maxDepth = 1 + below(40);
    job.sharesLight = oneIn(2);
    job.isAdaptive = oneIn(2);
    if (job.gatherFrom == GatherSource::cells) leaveOutPhotonOptions(job);
    return job;
  }

 private:
  void setDensity(RenderJob& job) {
    job.control = anyOf({DensityControl::off, DensityControl::density, DensityControl::probability});
    job.probabilityFloor = oneIn(2) ? unit() : 0;
    job.causticDensity = magnitude(-6, 6);
    job.globalDensity = magnitude(-6, 6);
    if (oneIn(4)) job.constantDensity = magnitude(-12, 12);
    if (oneIn(2)) job.redistribute = 1 + below(20);
    if (oneIn(2)) job.quota = 1 + below(20);
    job.acceptance = anyOf({Acceptance::step, Acceptance::cosine});
    job.shares = anyOf({PowerShares::count, PowerShares::distance, PowerShares::direction});
    job.hasProgramLimits = oneIn(4);
  }

  void setPhotons(RenderJob& job) {
    job.importons = 1u << below(12);
    job.emission = anyOf({EmissionChoice::automatic, EmissionChoice::power, EmissionChoice::guided});
    job.guideWeight = anyOf({GuideWeight::importance, GuideWeight::deficit, GuideWeight::potential});
    job.shooting = anyOf({PhotonsShot::all, PhotonsShot::enough});
    job.lookup = anyOf({MapLookup::radius, MapLookup::nearest});
    job.irradiance = anyOf({IrradianceCache::off, IrradianceCache::photons, IrradianceCache::importons});
    if (oneIn(2)) job.lookupPhotons = 1 + below(200);
    if (oneIn(2)) job.nearestImportons = 2 + below(200);
    if (oneIn(2)) job.photonBatch = 1u << below(12);
    job.choosesLookups = oneIn(4);
  }

  /// What would make gather rays read photons.
  static void leaveOutPhotonOptions(RenderJob& job) {
    job.control = DensityControl::density;
    job.redistribute.reset();
    job.lookup.reset();
    job.irradiance = IrradianceCache::off;
  }

  unsigned seed_;
};

class RandomScenes : public RenderTest {
 protected:
  static void expectSane(unsigned seed) {
    const RenderJob job = RandomJob(seed).make();
    Rendered r;
    ASSERT_NO_THROW(r = renderScene(job, RandomScene(seed).make())) << "seed " << seed;
    EXPECT_TRUE(isSane(r.image)) << "seed " << seed;
    if (job.control == DensityControl::probability) return;  // the power of what is stored is right in the mean alone
    EXPECT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits) << "seed " << seed;
    EXPECT_EQ(r.stats.caustic.fluxMap, r.stats.caustic.fluxHits) << "seed " << seed;
  }
};

TEST_F(RandomScenes, SlowAreFiniteAndKeepAllPower) {
  const StabilityCase listed(52, "random scenes over twelve orders of magnitude", "finite, not negative, power exact");
  const unsigned first = fromEnvironment("IMPORTON_RANDOM_FIRST", 1);
  for (unsigned seed = first; seed < first + fromEnvironment("IMPORTON_RANDOM_SCENES", 256); ++seed) expectSane(seed);
}

}  // namespace
}  // namespace importon::test
