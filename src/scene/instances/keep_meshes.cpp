#include "scene/instances/keep_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/z_order.h"

namespace importon {
namespace {

constexpr std::size_t kFewest = 8;           // triangles of a part that is kept
constexpr double kLargestCondition = 1e4;    // of a transform: its size times that of its inverse
constexpr float kLargestCoordinate = 1e15f;  // as in scene/geometry.cpp

double sizeOf(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

bool canBePlaced(const glm::dmat4& worldFromObject) {
  const glm::dmat3 linear(worldFromObject);
  const double determinant = glm::determinant(linear);
  const double condition = sizeOf(linear) * sizeOf(glm::inverse(linear));
  return determinant != 0 && std::isfinite(determinant) && condition <= kLargestCondition &&
         glm::length(glm::dvec3(worldFromObject[3])) <= static_cast<double>(kLargestCoordinate);
}

/// The box of a part's vertices; false where one is not usable: then each instance must be looked at.
bool boundPart(const MeshPart& part, vec3& low, vec3& high) {
  low = vec3(std::numeric_limits<float>::max());
  high = -low;
  for (const vec3& p : part.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) <= kLargestCoordinate)) return false;
  }
  return true;
}

class PageMaker {
 public:
  PageMaker(Scene& scene, std::size_t first) : scene_(scene), triangles_(std::span(scene.triangles).subspan(first)) {}

  std::vector<MeshPage> make() {
    sort();
    std::vector<MeshPage> pages((triangles_.size() + kPageTriangles - 1) / kPageTriangles);
    for (std::size_t i = 0; i < pages.size(); ++i) {
      const std::size_t begin = i * kPageTriangles;
      pages[i] = pageOf(triangles_.subspan(begin, std::min<std::size_t>(kPageTriangles, triangles_.size() - begin)));
    }
    return pages;
  }

 private:
  [[nodiscard]] vec3 centroid(const Triangle& t) const {
    return (scene_.positions[t.v0] + scene_.positions[t.v1] + scene_.positions[t.v2]) / 3.0f;
  }

  /// Along a curve that keeps near triangles together.
  void sort() {
    vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const Triangle& t : triangles_) {
      low = glm::min(low, centroid(t));
      high = glm::max(high, centroid(t));
    }
    const vec3 sides = high - low;
    const float extent = std::max({sides.x, sides.y, sides.z, std::numeric_limits<float>::min()});
    std::vector<std::pair<std::uint32_t, Triangle>> order;
    order.reserve(triangles_.size());
    for (const Triangle& t : triangles_) order.emplace_back(zOrderCode(centroid(t), low, extent), t);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < order.size(); ++i) triangles_[i] = order[i].second;
  }

  [[nodiscard]] MeshPage pageOf(std::span<const Triangle> triangles) const {
    MeshPage page;
    page.low = vec3(std::numeric_limits<float>::max());
    page.high = -page.low;
    page.sample = centroid(triangles[triangles.size() / 2]);
    for (const Triangle& t : triangles) {
      const vec3 a = scene_.positions[t.v0], b = scene_.positions[t.v1], c = scene_.positions[t.v2];
      page.low = glm::min(page.low, glm::min(a, glm::min(b, c)));
      page.high = glm::max(page.high, glm::max(a, glm::max(b, c)));
      page.areas.add(a, b, c);
      page.vectorArea += 0.5 * glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    }
    return page;
  }

  Scene& scene_;
  std::span<Triangle> triangles_;
};

Placement placementOf(const MeshInstance& instance) {
  return {glm::dmat3(instance.worldFromObject), glm::dvec3(instance.worldFromObject[3])};
}

}  // namespace

MeshKeeper::MeshKeeper(std::span<const MeshInstance> instances, const KeepRule& rule) {
  using Kind = std::pair<const MeshPart*, uint>;  // part and material, which may differ with an instance's size
  const auto kindOf = [](const MeshInstance& instance) { return Kind(instance.part, instance.material); };
  std::map<Kind, std::size_t> copies, keptOf;
  for (const MeshInstance& instance : instances)
    if (!instance.emits && canBePlaced(instance.worldFromObject)) ++copies[kindOf(instance)];
  for (const MeshInstance& instance : instances) {
    const auto found = copies.find(kindOf(instance));
    const std::size_t triangles = instance.part->triangles.size();
    const bool isWorth = found != copies.end() && triangles >= kFewest &&
                         (found->second - 1) * triangles >= rule.leastSaved && !instance.emits &&
                         canBePlaced(instance.worldFromObject);
    if (!isWorth) {
      flat_.push_back(instance);
      continue;
    }
    const auto [entry, isNew] = keptOf.try_emplace(kindOf(instance), kept_.size());
    if (isNew) {
      Kept kept{instance.part, instance.material, {}, {}, {}};
      if (!boundPart(*instance.part, kept.low, kept.high)) {
        copies.erase(found);  // to be flattened, all of them
        keptOf.erase(entry);
        flat_.push_back(instance);
        continue;
      }
      kept_.push_back(std::move(kept));
    }
    kept_[entry->second].instances.push_back(&instance);
  }
}

void MeshKeeper::includeKept(glm::dvec3& low, glm::dvec3& high) const {
  for (const Kept& kept : kept_)
    for (const MeshInstance* instance : kept.instances)
      placementOf(*instance).includeBox(kept.low, kept.high, low, high);
}

void MeshKeeper::place(Scene& scene, const std::function<std::size_t(const MeshPart&, uint material)>& append) const {
  std::size_t pages = 0;
  for (const Kept& kept : kept_) {
    const std::size_t first = append(*kept.part, kept.material);
    if (scene.triangles.size() == first) continue;
    PlacedMesh mesh{static_cast<uint>(first), static_cast<uint>(scene.triangles.size() - first), {}};
    mesh.pages = PageMaker(scene, first).make();
    for (const MeshInstance* instance : kept.instances) {
      PlacedInstance placed{static_cast<uint>(scene.placed.meshes.size()), static_cast<uint>(pages), {}};
      const glm::dmat4& m = instance->worldFromObject;
      for (int row = 0; row < 3; ++row)
        placed.renderFromObject[static_cast<std::size_t>(row)] =
            vec4(glm::dvec4(m[0][row], m[1][row], m[2][row], m[3][row] - scene.worldFromRender[row]));
      scene.placed.instances.push_back(placed);
      pages += mesh.pages.size();
      if (pages > kMostPages)
        throw SceneError(fmt::format("there are more instances than have {} million triangles",
                                     std::size_t{kMostPages} * kPageTriangles / 1'000'000),
                         scene.file.string(), "reduce the scene");
    }
    scene.placed.meshes.push_back(std::move(mesh));
  }
}

}  // namespace importon
