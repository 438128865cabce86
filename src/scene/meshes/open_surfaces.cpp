#include "scene/meshes/open_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scene/meshes/border_loops.h"
#include "scene/meshes/groups.h"
#include "scene/meshes/weld.h"

namespace importon {
namespace {

constexpr double kNoSpace = 1e-7;     // volume over the area to the power 3/2; of a sphere 0.094
constexpr double kSmallHole = 0.002;  // of the area of its surface; the mouth of a bottle is 0.004

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
    sealHoles();
    peel();
    judgeClosed();
  }
  [[nodiscard]] const std::vector<MeshFace>& faces() const { return faces_; }

 private:
  static constexpr std::size_t kNotSealed = static_cast<std::size_t>(-1);

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

  [[nodiscard]] std::size_t edgeCount() const { return firstUse_.size() - 1; }
  [[nodiscard]] std::size_t usesOf(std::size_t edge) const { return firstUse_[edge + 1] - firstUse_[edge]; }

  [[nodiscard]] std::vector<Border> borders() const {
    std::vector<Border> found;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const MeshFace& face = faces_[i];
      if (isDegenerate(face)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (usesOf(face.edges[k]) != 1) continue;
        const std::size_t next = (k + 1) % 3;
        found.push_back({face.places[static_cast<int>(k)], face.places[static_cast<int>(next)],
                         glm::dvec3(face.corners[k]), glm::dvec3(face.corners[next]), face.edges[k], i});
      }
    }
    std::ranges::stable_sort(found, {}, &Border::from);
    return found;
  }

  /// Holes that are small for the surface that they are in count as closed: what a scan has missed, and where the long
  /// side of a face lies along the short ones of others.
  void sealHoles() {
    Groups<std::size_t> groups(faces_.size());
    for (std::size_t e = 0; e < edgeCount(); ++e) joinUses(e, groups, false);
    const std::vector<Border> all = borders();
    const std::vector<BorderLoop> loops = findLoops(all);
    for (const BorderLoop& loop : loops)
      for (const std::size_t i : loop.borders) groups.unite(all[i].face, all[loop.borders.front()].face);
    std::vector<double> areas(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i) areas[groups.of(i)] += areaOf(faces_[i]);
    sealOf_.assign(edgeCount(), kNotSealed);
    for (const BorderLoop& loop : loops) {
      if (loop.area > kSmallHole * areas[groups.of(all[loop.borders.front()].face)]) continue;
      std::vector<std::size_t>& edges = seals_.emplace_back();
      for (const std::size_t i : loop.borders) {
        edges.push_back(all[i].edge);
        sealOf_[all[i].edge] = seals_.size() - 1;
      }
    }
  }

  void joinUses(std::size_t edge, Groups<std::size_t>& groups, bool isClosedOnly) const {
    for (std::size_t use = firstUse_[edge] + 1; use < firstUse_[edge + 1]; ++use)
      for (std::size_t before = use; before-- > firstUse_[edge];)
        if (!isClosedOnly || (!faces_[faceOfUse_[use]].isOpen && !faces_[faceOfUse_[before]].isOpen)) {
          groups.unite(faceOfUse_[use], faceOfUse_[before]);
          break;
        }
  }

  /// Takes away faces with an edge of their own until there is none.
  void peel() {
    std::vector<std::size_t> left(edgeCount()), pending;
    for (std::size_t e = 0; e < left.size(); ++e) {
      left[e] = usesOf(e);
      if (left[e] == 1 && sealOf_[e] == kNotSealed) pending.push_back(e);
    }
    while (!pending.empty()) {
      const std::size_t edge = pending.back();
      pending.pop_back();
      for (std::size_t use = firstUse_[edge]; use < firstUse_[edge + 1]; ++use) {
        MeshFace& face = faces_[faceOfUse_[use]];
        if (face.isOpen) continue;
        face.isOpen = true;
        for (const std::size_t other : face.edges) {
          if (sealOf_[other] != kNotSealed) breakSeal(sealOf_[other], pending);
          if (--left[other] == 1) pending.push_back(other);
        }
      }
    }
  }

  void breakSeal(std::size_t seal, std::vector<std::size_t>& pending) {
    for (const std::size_t edge : seals_[seal]) sealOf_[edge] = kNotSealed;
    pending.insert(pending.end(), seals_[seal].begin(), seals_[seal].end());
  }

  /// The shells of closed faces that are no solids are open.
  void judgeClosed() {
    Groups<std::size_t> groups(faces_.size());
    for (std::size_t e = 0; e < edgeCount(); ++e) joinUses(e, groups, true);
    for (const std::vector<std::size_t>& edges : seals_)
      if (sealOf_[edges.front()] != kNotSealed)
        for (const std::size_t e : edges) groups.unite(faceOfUse_[firstUse_[e]], faceOfUse_[firstUse_[edges.front()]]);
    std::vector<Shell> shells(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!faces_[i].isOpen) measure(faces_[i], shells[groups.of(i)]);
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!faces_[i].isOpen && !isDegenerate(faces_[i])) faces_[i].isOpen = !isSolid(shells[groups.of(i)]);
  }

  static double areaOf(const MeshFace& face) {
    const glm::dvec3 a(face.corners[0]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(face.corners[1]) - a, glm::dvec3(face.corners[2]) - a));
  }

  static void measure(const MeshFace& face, Shell& shell) {
    if (shell.isEmpty) shell.origin = glm::dvec3(face.corners[0]);
    shell.isEmpty = false;
    const glm::dvec3 a = glm::dvec3(face.corners[0]) - shell.origin, b = glm::dvec3(face.corners[1]) - shell.origin,
                     c = glm::dvec3(face.corners[2]) - shell.origin;
    shell.area += areaOf(face);
    if (face.hasVolume) shell.areaOfVolume += areaOf(face);
    shell.volume += glm::dot(a, glm::cross(b, c)) / 6;
  }

  static bool isSolid(const Shell& shell) {
    return std::abs(shell.volume) > kNoSpace * std::pow(shell.area, 1.5) && 2 * shell.areaOfVolume >= shell.area;
  }

  std::vector<MeshFace> faces_;
  std::vector<std::size_t> faceOfUse_, firstUse_;  // of each edge, one after the other; the end at last
  std::vector<std::vector<std::size_t>> seals_;    // edges of small holes
  std::vector<std::size_t> sealOf_;                // of each edge
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
