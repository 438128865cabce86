#include "scene/meshes/open_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "scene/meshes/weld.h"

namespace importon {
namespace {

constexpr double kNoSpace = 1e-7;  // volume over the area to the power 3/2; of a sphere 0.094

/// A triangle of any part.
struct MeshFace {
  uvec3 places;
  std::array<vec3, 3> corners;
  bool hasVolume = false;
  bool isOpen = false;
  std::array<std::size_t, 3> edges{};
};

bool isDegenerate(const MeshFace& f) {
  return f.places.x == f.places.y || f.places.y == f.places.z || f.places.z == f.places.x;
}

/// The faces of a mesh, and which of them share which edges. Faces without area have none, and are closed.
class Surface {
 public:
  explicit Surface(std::vector<MeshFace> faces) : faces_(std::move(faces)) {
    joinEdges();
    peel();
    judgeClosed();
  }
  [[nodiscard]] const std::vector<MeshFace>& faces() const { return faces_; }

 private:
  /// Of what is connected.
  struct Shell {
    double area = 0, areaOfVolume = 0, volume = 0;
    glm::dvec3 origin{0.0};
    bool isEmpty = true;
  };

  void joinEdges() {
    struct Use {
      std::uint64_t edge;
      std::size_t face;
      std::size_t side;
    };
    std::vector<Use> uses;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (isDegenerate(faces_[i])) continue;
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(faces_[i].places[k], faces_[i].places[(k + 1) % 3]);
        uses.push_back({std::uint64_t{a} << 32 | b, i, static_cast<std::size_t>(k)});
      }
    }
    std::ranges::sort(uses, {}, [](const Use& use) { return std::pair(use.edge, use.face); });
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (i == 0 || uses[i].edge != uses[i - 1].edge) firstUse_.push_back(i);
      faces_[uses[i].face].edges[uses[i].side] = firstUse_.size() - 1;
      faceOfUse_.push_back(uses[i].face);
    }
    firstUse_.push_back(uses.size());
  }

  /// Takes away faces with an edge of their own until there is none.
  void peel() {
    std::vector<std::size_t> left(firstUse_.size() - 1), pending;
    for (std::size_t e = 0; e < left.size(); ++e) {
      left[e] = firstUse_[e + 1] - firstUse_[e];
      if (left[e] == 1) pending.push_back(e);
    }
    while (!pending.empty()) {
      const std::size_t edge = pending.back();
      pending.pop_back();
      for (std::size_t use = firstUse_[edge]; use < firstUse_[edge + 1]; ++use) {
        MeshFace& face = faces_[faceOfUse_[use]];
        if (face.isOpen) continue;
        face.isOpen = true;
        for (const std::size_t other : face.edges)
          if (--left[other] == 1) pending.push_back(other);
      }
    }
  }

  std::size_t rootOf(std::size_t face) {
    while (parent_[face] != face) face = parent_[face] = parent_[parent_[face]];
    return face;
  }

  /// The shells of closed faces that are no solids are open.
  void judgeClosed() {
    parent_.resize(faces_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t e = 0; e + 1 < firstUse_.size(); ++e) {
      std::size_t first = faces_.size();
      for (std::size_t use = firstUse_[e]; use < firstUse_[e + 1]; ++use) {
        const std::size_t face = faceOfUse_[use];
        if (faces_[face].isOpen) continue;
        if (first == faces_.size()) first = face;
        parent_[rootOf(face)] = rootOf(first);
      }
    }
    std::vector<Shell> shells(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!faces_[i].isOpen) measure(faces_[i], shells[rootOf(i)]);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!faces_[i].isOpen && !isDegenerate(faces_[i])) faces_[i].isOpen = !isSolid(shells[rootOf(i)]);
  }

  static void measure(const MeshFace& face, Shell& shell) {
    if (shell.isEmpty) shell.origin = glm::dvec3(face.corners[0]);
    shell.isEmpty = false;
    const glm::dvec3 a = glm::dvec3(face.corners[0]) - shell.origin, b = glm::dvec3(face.corners[1]) - shell.origin,
                     c = glm::dvec3(face.corners[2]) - shell.origin;
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    shell.area += area;
    if (face.hasVolume) shell.areaOfVolume += area;
    shell.volume += glm::dot(a, glm::cross(b, c)) / 6;
  }

  static bool isSolid(const Shell& shell) {
    return std::abs(shell.volume) > kNoSpace * std::pow(shell.area, 1.5) && 2 * shell.areaOfVolume >= shell.area;
  }

  std::vector<MeshFace> faces_;
  std::vector<std::size_t> faceOfUse_, firstUse_;  // of each edge, one after the other; the end at last
  std::vector<std::size_t> parent_;
};

std::vector<MeshFace> facesOf(const std::vector<MeshPart>& parts, const std::vector<bool>& hasVolume) {
  const std::vector<std::vector<uint>> places = weldVertices(parts);
  std::vector<MeshFace> faces;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const uvec3& t : parts[i].triangles) {
      MeshFace& face = faces.emplace_back();
      for (int k = 0; k < 3; ++k) {
        face.places[k] = places[i][t[k]];
        face.corners[static_cast<std::size_t>(k)] = parts[i].positions[t[k]];
      }
      face.hasVolume = hasVolume[i];
    }
  }
  return faces;
}

}  // namespace

void splitOpenSurfaces(std::vector<MeshPart>& parts, const std::vector<bool>& hasVolume) {
  if (std::ranges::none_of(hasVolume, [](bool has) { return has; })) return;
  const Surface surface(facesOf(parts, hasVolume));
  std::vector<MeshPart> all;
  auto face = surface.faces().begin();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<uvec3> closed, open;
    for (const uvec3& triangle : parts[i].triangles) (face++->isOpen ? open : closed).push_back(triangle);
    if (hasVolume[i] && !open.empty() && !closed.empty()) {
      MeshPart& sheet = all.emplace_back(partOf(parts[i], open));
      sheet.isOpen = true;
      all.push_back(partOf(parts[i], closed));
    } else {
      parts[i].isOpen = hasVolume[i] && closed.empty();
      all.push_back(std::move(parts[i]));
    }
  }
  parts = std::move(all);
}

}  // namespace importon
