#include "scene/geometry.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/packing.h"

namespace importon {
namespace {

constexpr double kLargestCoordinate = 1e15;
constexpr std::size_t kGrain = 16384;

bool isFinite(const vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

/// False for NaN too.
bool isUsable(const glm::dvec3& p) {
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
         std::abs(p.z) <= kLargestCoordinate;
}

/// Transforms of one instance, or of none.
class InstanceFrame {
 public:
  explicit InstanceFrame(const glm::dmat4& worldFromObject)
      : worldFromObject_(worldFromObject), linear_(worldFromObject) {
    isMirrored_ = glm::determinant(linear_) < 0;
    // The cofactors are the inverse transpose times the determinant: they exist for flattening transforms too.
    cofactors_ = glm::dmat3(glm::cross(linear_[1], linear_[2]), glm::cross(linear_[2], linear_[0]),
                            glm::cross(linear_[0], linear_[1]));
    if (isMirrored_) cofactors_ = -cofactors_;
  }

  [[nodiscard]] bool isMirrored() const { return isMirrored_; }
  [[nodiscard]] glm::dvec3 worldPosition(const vec3& position) const {
    return linear_ * glm::dvec3(position) + glm::dvec3(worldFromObject_[3]);
  }

  /// kNone if the normal has no direction.
  [[nodiscard]] uint normal(const vec3& objectNormal) const {
    const glm::dvec3 normal = cofactors_ * glm::dvec3(objectNormal);
    const double length = glm::length(normal);
    return length > 0 && std::isfinite(length) ? packNormal(normal / length) : kNone;
  }

  /// kNone if the tangent has no direction. A mirror turns the bitangent round against cross(normal, tangent).
  [[nodiscard]] uint tangent(const vec4& objectTangent) const {
    const glm::dvec3 tangent = linear_ * glm::dvec3(objectTangent);
    const double length = glm::length(tangent);
    if (!(length > 0) || !std::isfinite(length)) return kNone;
    return packTangent(tangent / length, (objectTangent.w < 0) != isMirrored_);
  }

 private:
  glm::dmat4 worldFromObject_;
  glm::dmat3 linear_;
  glm::dmat3 cofactors_{1.0};
  bool isMirrored_ = false;
};

/// Includes all usable vertices of an instance, in the world.
void includeVertices(const MeshInstance& instance, glm::dvec3& low, glm::dvec3& high) {
  const InstanceFrame frame(instance.worldFromObject);
  for (const vec3& position : instance.part->positions) {
    const glm::dvec3 world = frame.worldPosition(position);
    if (!isUsable(world)) continue;
    low = glm::min(low, world);
    high = glm::max(high, world);
  }
}

vec4 usableColor(const vec4& color) {
  vec4 result;
  for (int c = 0; c < 4; ++c) result[c] = std::isfinite(color[c]) ? std::max(color[c], 0.0f) : 1.0f;
  return result;
}

/// Writes the arrays of the scene, instance by instance.
class Assembler {
 public:
  Assembler(Scene& scene, const std::string& name) : scene_(scene), name_(name) {}

  /// Of the world.
  void append(const MeshInstance& instance) {
    append(*instance.part, InstanceFrame(instance.worldFromObject), scene_.worldFromRender, instance.material);
  }
  /// In its own space. Returns its first triangle.
  std::size_t appendMesh(const MeshPart& part, uint material) {
    const std::size_t first = scene_.triangles.size();
    append(part, InstanceFrame(glm::dmat4(1.0)), glm::dvec3(0.0), material);
    return first;
  }

  void warn(Log& log) const {
    if (nonFinite_ > 0) {
      log.warn("non-finite triangles", fmt::format("{}: {} triangles with a corner that is not finite or beyond {} "
                                                   "were dropped",
                                                   name_, nonFinite_, kLargestCoordinate));
    }
    if (withoutArea_ > 0) {
      log.warn("triangles without area",
               fmt::format("{}: {} triangles without area were dropped", name_, withoutArea_));
    }
    if (badUvs_ > 0) {
      log.warn("non-finite texture coordinates",
               fmt::format("{}: {} texture coordinates that are not finite became 0", name_, badUvs_.load()));
    }
  }

  [[nodiscard]] std::size_t dropped() const { return nonFinite_ + withoutArea_; }

 private:
  void append(const MeshPart& part, const InstanceFrame& frame, const glm::dvec3& origin, uint material) {
    const std::size_t first = scene_.positions.size(), count = part.positions.size();
    scene_.positions.resize(first + count);
    scene_.vertices.resize(first + count);
    isUsable_.assign(count, 1);
    parallelFor(count, kGrain, 0, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) writeVertex(part, frame, origin, i, first);
    });
    appendTriangles(part, frame.isMirrored(), material, first);
  }

  void writeVertex(const MeshPart& part, const InstanceFrame& frame, const glm::dvec3& origin, std::size_t i,
                   std::size_t first) {
    const glm::dvec3 world = frame.worldPosition(part.positions[i]);
    isUsable_[i] = isUsable(world) ? 1 : 0;
    scene_.positions[first + i] = isUsable(world) ? vec3(world - origin) : vec3(0.0f);
    Vertex& vertex = scene_.vertices[first + i];
    vertex.uv0 = usableUv(part.uv0, i);
    vertex.uv1 = usableUv(part.uv1, i);
    vertex.normal = part.normals.empty() ? kNone : frame.normal(part.normals[i]);
    vertex.tangent = part.tangents.empty() ? kNone : frame.tangent(part.tangents[i]);
    const uvec2 color = packColor(part.colors.empty() ? vec4(1.0f) : usableColor(part.colors[i]));
    vertex.colorRG = color.x;
    vertex.colorBA = color.y;
  }

  vec2 usableUv(const std::vector<vec2>& uvs, std::size_t i) {
    if (uvs.empty()) return vec2(0.0f);
    if (isFinite(uvs[i])) return uvs[i];
    ++badUvs_;
    return vec2(0.0f);
  }

  void appendTriangles(const MeshPart& part, bool isMirrored, uint material, std::size_t first) {
    const auto base = static_cast<uint>(first);
    for (uvec3 corners : part.triangles) {
      if (isMirrored) std::swap(corners.y, corners.z);
      if (isUsable_[corners.x] == 0 || isUsable_[corners.y] == 0 || isUsable_[corners.z] == 0) {
        ++nonFinite_;
        continue;
      }
      corners += base;
      if (!hasArea(corners)) {
        ++withoutArea_;
        continue;
      }
      scene_.triangles.push_back({corners.x, corners.y, corners.z, material});
    }
  }

  /// Exact for corners of like magnitude: products of float differences fit a double.
  [[nodiscard]] bool hasArea(const uvec3& corners) const {
    const glm::dvec3 origin(scene_.positions[corners.x]);
    const glm::dvec3 e1 = glm::dvec3(scene_.positions[corners.y]) - origin;
    const glm::dvec3 e2 = glm::dvec3(scene_.positions[corners.z]) - origin;
    return glm::cross(e1, e2) != glm::dvec3(0.0);
  }

  Scene& scene_;
  const std::string& name_;
  std::vector<char> isUsable_;  // per vertex of the instance
  std::size_t nonFinite_ = 0;
  std::size_t withoutArea_ = 0;
  std::atomic<std::size_t> badUvs_ = 0;
};

/// Before anything is written.
void checkSize(std::span<const MeshInstance> flat, const std::string& name) {
  constexpr std::size_t kMost = std::size_t{1} << 26;
  std::size_t vertices = 0, triangles = 0;
  for (const MeshInstance& instance : flat) {
    vertices += instance.part->positions.size();
    triangles += instance.part->triangles.size();
  }
  if (vertices <= kMost && triangles <= kMost) return;
  throw SceneError(fmt::format("the scene has more than {} triangles or vertices, instances included", kMost), name,
                   "reduce the scene");
}

void setBounds(Scene& scene) {
  scene.boundsMin = vec3(std::numeric_limits<float>::max());
  scene.boundsMax = -scene.boundsMin;
  for (const Triangle& triangle : scene.worldTriangles()) {
    for (const uint corner : {triangle.v0, triangle.v1, triangle.v2}) {
      scene.boundsMin = glm::min(scene.boundsMin, scene.positions[corner]);
      scene.boundsMax = glm::max(scene.boundsMax, scene.positions[corner]);
    }
  }
  if (scene.placed.isEmpty()) return;
  glm::dvec3 low(scene.boundsMin), high(scene.boundsMax);
  scene.placed.visitPages([&](const PlacedInstance&, const Placement& placement, const MeshPage& page) {
    placement.includeBox(page.low, page.high, low, high);
  });
  scene.boundsMin = vec3(low);
  scene.boundsMax = vec3(high);
}

}  // namespace

glm::dvec3 chooseOrigin(const glm::dvec3& low, const glm::dvec3& high) {
  constexpr double kSizesFromOrigin = 4.0;
  const glm::dvec3 centre = low + (high - low) * 0.5;
  if (glm::length(centre) <= kSizesFromOrigin * glm::length(high - low)) return glm::dvec3(0.0);
  // Stored as floats on the way: optimisers have been seen to drop a mere conversion there and back.
  glm::dvec3 rounded;
  for (int axis = 0; axis < 3; ++axis) {
    const volatile float stored = static_cast<float>(centre[axis]);
    rounded[axis] = static_cast<double>(stored);
  }
  return rounded;
}

void assembleGeometry(std::span<const MeshInstance> instances, Scene& scene, const std::string& name, Log& log,
                      const KeepRule& rule) {
  const MeshKeeper keeper(instances, rule);
  checkSize(keeper.flat(), name);
  glm::dvec3 low(kLargestCoordinate);
  glm::dvec3 high(-kLargestCoordinate);
  for (const MeshInstance& instance : keeper.flat()) includeVertices(instance, low, high);
  keeper.includeKept(low, high);
  if (low.x <= high.x) scene.worldFromRender = chooseOrigin(low, high);
  Assembler assembler(scene, name);
  for (const MeshInstance& instance : keeper.flat()) assembler.append(instance);
  keeper.place(scene, [&](const MeshPart& part, uint material) { return assembler.appendMesh(part, material); });
  assembler.warn(log);
  if (scene.triangles.empty()) {
    const char* what = assembler.dropped() > 0 ? "no triangle is left to render" : "the scene has no triangle";
    throw SceneError(what, name, "export meshes with triangles, and list their nodes in the scene");
  }
  setBounds(scene);
}

}  // namespace importon
