// Scenes that nobody would make: random triangles, materials, lights and cameras over twelve orders of magnitude.
#include <cmath>
#include <cstdlib>
#include <random>

#include "render_helper.h"

namespace importon::test {
namespace {

/// How many scenes: IMPORTON_RANDOM_SCENES, for a long search.
int sceneCount(int otherwise) {
  const char* const text = std::getenv("IMPORTON_RANDOM_SCENES");
  return text == nullptr ? otherwise : std::atoi(text);
}

class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {}

  Scene make() {
    scale_ = magnitude(-6, 6);
    const int materials = 1 + below(6), shapes = 1 + below(12), lights = 1 + below(5);
    for (int i = 0; i < materials; ++i) builder_.material(anyMaterial());
    for (int i = 0; i < shapes; ++i) addShape(static_cast<uint>(below(materials)));
    for (int i = 0; i < lights; ++i) addLight();
    const glm::dvec3 eye = scale_ * point();
    builder_.camera(eye, eye + scale_ * direction(), 0.01 + 3.0 * unit(), 4 + below(8), 4 + below(8));
    return builder_.finish();
  }

 private:
  double unit() { return std::uniform_real_distribution<double>()(random_); }
  int below(int limit) { return static_cast<int>(unit() * limit); }
  double magnitude(double low, double high) { return std::pow(10.0, low + (high - low) * unit()); }
  glm::dvec3 point() { return glm::dvec3(unit(), unit(), unit()) * 2.0 - 1.0; }
  glm::dvec3 direction() { return glm::normalize(point() + glm::dvec3(0, 1e-3, 0)); }
  vec3 color() { return vec3(unit(), unit(), unit()); }

  Material anyMaterial() {
    Material m = diffuse(color());
    m.specular = static_cast<float>(below(2));
    m.metallic = below(3) == 0 ? 1.0f : 0.0f;
    m.roughness = below(2) == 0 ? 0.0f : static_cast<float>(unit());
    m.transmission = below(3) == 0 ? 1.0f : 0.0f;
    m.ior = static_cast<float>(1 + 2 * unit());
    m.clearcoat = below(4) == 0 ? static_cast<float>(unit()) : 0.0f;
    m.clearcoatRoughness = static_cast<float>(unit());
    m.absorption = below(4) == 0 ? color() * static_cast<float>(magnitude(-6, 6)) : vec3(0.0f);
    m.flags = (below(2) == 0 ? kMaterialDoubleSided : 0u) | (below(2) == 0 ? kMaterialSolid : 0u);
    if (below(4) == 0) {
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
        return builder_.box(material, centre - size, centre + size, below(2) == 0 ? Facing::inside : Facing::outside);
      default:
        return builder_.icosphere(material, centre, size, below(3), below(2) == 0 ? Facing::inside : Facing::outside, Shading::smooth);
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

  std::mt19937 random_;
  SceneBuilder builder_;
  double scale_ = 1;
};

class RandomScenes : public RenderTest {
 protected:
  void renderAll(unsigned first, int count) const {
    for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
      const Scene scene = RandomScene(seed).make();
      for (const Integrator integrator : {Integrator::path, Integrator::photon}) {
        RenderJob job = makeJob(integrator, 2);
        if (integrator == Integrator::photon) job.photons = 1u << 10;
        job.forcesAllFeatures = seed % 8 == 0;
        const Rendered r = renderScene(job, scene);
        ASSERT_TRUE(isSane(r.image)) << "seed " << seed << (integrator == Integrator::path ? ", paths" : ", photons");
        ASSERT_EQ(r.stats.global.fluxMap, r.stats.global.fluxHits) << "seed " << seed;
        ASSERT_EQ(r.stats.caustic.fluxMap, r.stats.caustic.fluxHits) << "seed " << seed;
      }
    }
  }
};

TEST_F(RandomScenes, SlowAreFiniteAndKeepAllPower) {
  const StabilityCase listed(52, "random scenes over twelve orders of magnitude", "finite, not negative, power exact");
  renderAll(1, sceneCount(4));
}

}  // namespace
}  // namespace importon::test
