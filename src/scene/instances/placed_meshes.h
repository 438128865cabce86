/// Meshes that a scene has once and shows in many places. A placed triangle's number, as hits have it, tells the page
/// of its instance that it is in: shaders/shared/scene_data.h.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shared/scene_data.h"

namespace importon {

/// For triangles of areas A and unit normals n: the sum of A n nᵀ. Its trace is their area; so is, after a linear map
/// with the cofactors C, the root of trace · trace(C T Cᵀ), exactly where the triangles lie in parallel planes or the
/// map has one scale, and else as far as their normals differ too much (Jensen). m².
class AreaTensor {
 public:
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
  void add(const AreaTensor& other);
  [[nodiscard]] double area() const { return static_cast<double>(sums_[0] + sums_[1] + sums_[2]); }
  [[nodiscard]] double areaAfter(const glm::dmat3& cofactors) const;
  /// Likewise, as it is seen along an axis: the sum of A |n_axis| after the map.
  [[nodiscard]] double areaSeenAlong(int axis, const glm::dmat3& cofactors) const;

 private:
  /// vᵀ T v.
  [[nodiscard]] double quadratic(const glm::dvec3& v) const;

  std::array<float, 6> sums_{};  // xx, yy, zz, xy, xz, yz
};

/// Triangles of a mesh that lie close together, kPageTriangles of them, in the last page fewer. Object space.
struct MeshPage {
  vec3 low{0}, high{0}, sample{0};  // `sample`: a point on its surface
  AreaTensor areas;
  glm::dvec3 vectorArea{0};  // sum of area times normal, m²
};

struct PlacedMesh {
  uint firstTriangle = 0, triangleCount = 0;  // in Scene::triangles, after those of the world; in object space
  std::vector<MeshPage> pages;
};

/// A linear map and a translation.
struct Placement {
  glm::dmat3 linear{1.0};
  glm::dvec3 translation{0.0};

  [[nodiscard]] glm::dvec3 operator()(const vec3& point) const { return linear * glm::dvec3(point) + translation; }
  /// Of areas and normals: the inverse transpose times the determinant.
  [[nodiscard]] glm::dmat3 cofactors() const;
  /// Of the axis-parallel box around a placed box: adds it to `low` and `high`.
  void includeBox(const vec3& boxLow, const vec3& boxHigh, glm::dvec3& low, glm::dvec3& high) const;
};

struct PlacedInstance {
  uint mesh = 0;
  uint firstPage = 0;                         // counted over all instances
  std::array<vec4, 3> renderFromObject{};     // rows
  [[nodiscard]] Placement placement() const;  // what the floats say
};

struct PlacedMeshes {
  std::vector<PlacedMesh> meshes;  // in the order of their triangles
  std::vector<PlacedInstance> instances;

  [[nodiscard]] bool isEmpty() const { return instances.empty(); }
  [[nodiscard]] std::size_t pageCount() const;
  /// Calls visit(instance, placement, page of its mesh) for each page of each instance.
  template <class Visit>
  void visitPages(Visit visit) const {
    for (const PlacedInstance& instance : instances) {
      const Placement placement = instance.placement();
      for (const MeshPage& page : meshes[instance.mesh].pages) visit(instance, placement, page);
    }
  }
};

}  // namespace importon
