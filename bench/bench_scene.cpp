#include "bench/bench_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "base/log.h"
#include "scene/gltf_loader.h"

namespace importon::bench {
namespace {

BenchScene makeHeightField() {
  constexpr uint kCells = 708;
  BenchScene scene;
  for (uint y = 0; y <= kCells; ++y)
    for (uint x = 0; x <= kCells; ++x) {
      const double u = static_cast<double>(x) / kCells, v = static_cast<double>(y) / kCells;
      scene.positions.emplace_back(glm::dvec3(u, v, 0.1 * std::sin(40 * u) * std::cos(30 * v)));
    }
  for (uint y = 0; y < kCells; ++y)
    for (uint x = 0; x < kCells; ++x) {
      const uint a = y * (kCells + 1) + x, b = a + kCells + 1;
      scene.triangles.push_back({a, a + 1, b, 0});
      scene.triangles.push_back({a + 1, b + 1, b, 0});
    }
  return scene;
}

/// Points spread evenly over a scene's surfaces. The same numbers with every standard library.
class SurfaceSampler {
 public:
  SurfaceSampler(const BenchScene& scene, std::uint32_t seed) : scene_(scene), engine_(seed) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    double sum = 0;
    for (const Triangle& triangle : scene.triangles) {
      const Corners c = cornersOf(triangle);
      sum += glm::length(glm::cross(c.b - c.a, c.c - c.a));
      areaUpTo_.push_back(sum);
      for (const glm::dvec3& p : {c.a, c.b, c.c}) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    offset_ = 1e-5 * glm::length(high - low);
  }

  struct Point {
    glm::dvec3 position, normal;  // off the surface on the normal's side
  };
  Point point() {
    const auto found = std::lower_bound(areaUpTo_.begin(), areaUpTo_.end(), unit() * areaUpTo_.back());
    const auto index = std::min<std::ptrdiff_t>(found - areaUpTo_.begin(), std::ssize(areaUpTo_) - 1);
    const Corners c = cornersOf(scene_.triangles[static_cast<std::size_t>(index)]);
    const double r = std::sqrt(unit()), s = unit(), side = unit() < 0.5 ? -1.0 : 1.0;
    const glm::dvec3 normal = side * glm::normalize(glm::cross(c.b - c.a, c.c - c.a));
    return {c.a * (1 - r) + c.b * (r * (1 - s)) + c.c * (r * s) + normal * offset_, normal};
  }
  glm::dvec3 cosineDirection(const glm::dvec3& normal) {
    const double z = 2 * unit() - 1, phi = 2 * std::numbers::pi * unit(), r = std::sqrt(1 - z * z);
    return glm::normalize(normal * 1.0000001 + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
  }

 private:
  struct Corners {
    glm::dvec3 a, b, c;
  };
  [[nodiscard]] Corners cornersOf(const Triangle& t) const {
    return {scene_.positions[t.v0], scene_.positions[t.v1], scene_.positions[t.v2]};
  }
  double unit() { return static_cast<double>(engine_() >> 8) * 0x1p-24; }

  const BenchScene& scene_;
  std::mt19937 engine_;
  std::vector<double> areaUpTo_;
  double offset_ = 0;
};

}  // namespace

std::string setting(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::span<const char* const> benchSceneNames() {
  static constexpr std::array kNames{
      "height_field",  "cornell_box", "door_slit",   "rooms",       "ring",          "glass_ball", "pool",
      "glass_caustic", "cornell-box", "veach-bidir", "modern-hall", "water-caustic", "veach-ajar", "living-room-dense"};
  return kNames;
}

BenchScene loadBenchScene(const std::string& name) {
  if (name == "height_field") return makeHeightField();
  const std::filesystem::path own = std::filesystem::path(IMPORTON_SCENES) / name / (name + ".gltf");
  const std::string chosen = setting("IMPORTON_BENCH_SCENES");
  const std::filesystem::path folder = chosen.empty() ? IMPORTON_SHARED_SCENES : chosen;
  Log log(Log::Verbosity::quiet);
  Scene scene = loadGltf(std::filesystem::exists(own) ? own : folder / name / (name + ".glb"), log);
  return {std::move(scene.positions), std::move(scene.triangles)};
}

BenchScene turned(BenchScene scene) {
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 0.6, glm::normalize(glm::dvec3(1, 2, 3))));
  for (vec3& position : scene.positions) position = vec3(turn * glm::dvec3(position));
  return scene;
}

std::vector<Ray> makeBounceRays(const BenchScene& scene, std::size_t count) {
  SurfaceSampler sampler(scene, 1);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceSampler::Point from = sampler.point();
    rays.push_back({vec3(from.position), std::numeric_limits<float>::infinity(),
                    vec3(sampler.cosineDirection(from.normal)), static_cast<uint>(i)});
  }
  return rays;
}

std::vector<Ray> makeShadowRays(const BenchScene& scene, std::size_t count) {
  SurfaceSampler sampler(scene, 2);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 from = sampler.point().position, way = sampler.point().position - from;
    const double length = glm::length(way);
    rays.push_back({vec3(from), static_cast<float>(length), vec3(way / length), static_cast<uint>(i)});
  }
  return rays;
}

}  // namespace importon::bench
