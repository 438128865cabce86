#include "scene/meshes/tangents.h"

#include <algorithm>
#include <array>

#include "scene/images/texture_sampling.h"
#include "scene/meshes/groups.h"

namespace importon {
namespace {

using Corner = std::uint32_t;  // 3 · triangle + which

/// What makes vertices one: position, normal and UV, bit for bit but for the sign of zero.
using VertexKey = std::array<float, 8>;

/// Direction of growing u in a triangle, and how its UVs are wound.
struct FaceFrame {
  glm::dvec3 tangent{0.0};  // unit; zero: the UVs are of no use
  bool isMirrored = false;
};

/// A triangle with corners `p` and texture coordinates `uv`.
/// [Lengyel 2001, Computing Tangent Space Basis Vectors for an Arbitrary Mesh]
FaceFrame faceFrame(const glm::dvec3 (&p)[3], const glm::dvec2 (&uv)[3]) {
  const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
  const glm::dvec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
  const double uvArea = d1.x * d2.y - d2.x * d1.y;
  const glm::dvec3 tangent = (e1 * d2.y - e2 * d1.y) * (uvArea < 0 ? -1.0 : 1.0);
  const double length = glm::length(tangent);
  if (uvArea == 0 || !(length > 0) || !std::isfinite(length)) return {};
  return {tangent / length, uvArea > 0};  // v points down: the UVs of a front wind clockwise
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

/// What is left of `v` in the plane of the unit normal `n`; zero if that is next to nothing.
glm::dvec3 inPlane(const glm::dvec3& v, const glm::dvec3& n) {
  const glm::dvec3 flat = v - n * glm::dot(n, v);
  return glm::length(flat) > 1e-6 * glm::length(v) ? unitOrZero(flat) : glm::dvec3(0.0);
}

class TangentSpace {
 public:
  TangentSpace(MeshPart& part, const Texture& texture, std::vector<vec2> uvs)
      : part_(part), uvs_(std::move(uvs)), corners_(3 * part.triangles.size()), groups_(corners_) {
    for (std::size_t t = 0; t < part_.triangles.size(); ++t) addFace(t, texture);
    weldVertices();
  }

  void compute() {
    uniteAcrossEdges();
    joinUnusable();
    const std::vector<vec4> tangents = tangentOfGroups();
    splitVertices(tangents);
  }

 private:
  uint vertexOf(Corner corner) const { return part_.triangles[corner / 3][static_cast<int>(corner % 3)]; }
  glm::dvec3 positionOf(Corner corner) const { return part_.positions[vertexOf(corner)]; }
  static Corner after(Corner corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  const FaceFrame& faceOf(Corner corner) const { return faces_[corner / 3]; }
  bool isUsable(Corner corner) const { return faceOf(corner).tangent != glm::dvec3(0.0); }

  glm::dvec3 normalOf(Corner corner) const {
    return part_.normals.empty() ? faceNormals_[corner / 3] : unitOrZero(part_.normals[vertexOf(corner)]);
  }

  void addFace(std::size_t t, const Texture& texture) {
    glm::dvec3 p[3];
    glm::dvec2 uv[3];
    for (int k = 0; k < 3; ++k) {
      const uint vertex = part_.triangles[t][k];
      p[k] = part_.positions[vertex];
      uv[k] = transformUv(texture, uvs_[vertex]);
    }
    faces_.push_back(faceFrame(p, uv));
    if (part_.normals.empty()) faceNormals_.push_back(unitOrZero(glm::cross(p[1] - p[0], p[2] - p[0])));
  }

  VertexKey keyOf(Corner corner) const {
    const vec3 p = part_.positions[vertexOf(corner)], n(normalOf(corner));
    const vec2 uv = uvs_[vertexOf(corner)];
    VertexKey key{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
    for (float& value : key) value = std::isfinite(value) ? value + 0.0f : 0.0f;  // -0 + 0 is 0
    return key;
  }

  /// Numbers the vertices that are one.
  void weldVertices() {
    std::vector<VertexKey> keys(corners_);
    for (Corner c = 0; c < corners_; ++c) keys[c] = keyOf(c);
    std::vector<Corner> order(corners_);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, [&](Corner a, Corner b) { return keys[a] < keys[b]; });
    welded_.resize(corners_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool isNew = i == 0 || keys[order[i]] != keys[order[i - 1]];
      welded_[order[i]] = isNew ? static_cast<Corner>(i) : welded_[order[i - 1]];
    }
  }

  /// Triangles with an edge in common and UVs wound alike share the tangents of both its ends.
  void uniteAcrossEdges() {
    struct Edge {
      Corner low, high;  // welded
      bool isMirrored;
      Corner atLow, atHigh;
      auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edges;
    for (Corner c = 0; c < corners_; ++c) {
      if (!isUsable(c)) continue;
      const Corner next = after(c);
      const bool isUp = welded_[c] <= welded_[next];
      const Corner atLow = isUp ? c : next, atHigh = isUp ? next : c;
      edges.push_back({welded_[atLow], welded_[atHigh], faceOf(c).isMirrored, atLow, atHigh});
    }
    std::ranges::sort(edges);
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const Edge &a = edges[i - 1], &b = edges[i];
      if (a.low != b.low || a.high != b.high || a.isMirrored != b.isMirrored) continue;
      groups_.unite(a.atLow, b.atLow);
      groups_.unite(a.atHigh, b.atHigh);
    }
  }

  /// Corners of triangles without usable UVs take the tangent of the first other one at their vertex.
  void joinUnusable() {
    std::vector<Corner> firstAt(corners_, kNone);
    for (Corner c = 0; c < corners_; ++c)
      if (isUsable(c) && firstAt[welded_[c]] == kNone) firstAt[welded_[c]] = c;
    for (Corner c = 0; c < corners_; ++c)
      if (!isUsable(c) && firstAt[welded_[c]] != kNone) groups_.unite(c, firstAt[welded_[c]]);
  }

  /// The angle of the triangle at a corner, as seen along the normal there.
  double angleAt(Corner corner, const glm::dvec3& normal) const {
    const Corner next = after(corner);
    const glm::dvec3 here = positionOf(corner);
    const glm::dvec3 a = inPlane(positionOf(next) - here, normal), b = inPlane(positionOf(after(next)) - here, normal);
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
  }

  /// By the first corner of each group.
  std::vector<vec4> tangentOfGroups() {
    std::vector<glm::dvec3> sums(corners_, glm::dvec3(0.0));
    std::vector<char> isMirrored(corners_, 0);
    for (Corner c = 0; c < corners_; ++c) {
      if (!isUsable(c)) continue;
      const glm::dvec3 normal = normalOf(c);
      sums[groups_.of(c)] += angleAt(c, normal) * inPlane(faceOf(c).tangent, normal);
      isMirrored[groups_.of(c)] = faceOf(c).isMirrored ? 1 : 0;
    }
    std::vector<vec4> tangents(corners_);
    for (Corner c = 0; c < corners_; ++c) {
      // Green of a normal map points up and v down: the bitangent, w cross(normal, tangent), runs against v.
      const glm::dvec3 tangent = unitOrZero(sums[c]);
      const bool isNone = tangent == glm::dvec3(0.0);
      tangents[c] = vec4(vec3(tangent), !isNone && isMirrored[c] != 0 ? -1.0f : 1.0f);
    }
    return tangents;
  }

  /// A vertex keeps its place for one of its groups; each other one gets a copy of it.
  void splitVertices(const std::vector<vec4>& tangents) {
    part_.tangents.assign(part_.positions.size(), vec4(0.0f, 0.0f, 0.0f, 1.0f));
    std::vector<std::pair<uint, Corner>> uses;  // vertex and group
    for (Corner c = 0; c < corners_; ++c) uses.emplace_back(vertexOf(c), groups_.of(c));
    std::ranges::sort(uses);
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    std::vector<uint> places;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const bool isFirst = i == 0 || uses[i].first != uses[i - 1].first;
      places.push_back(isFirst ? uses[i].first : duplicateVertex(part_, uses[i].first));
      part_.tangents[places.back()] = tangents[uses[i].second];
    }
    for (Corner c = 0; c < corners_; ++c) {
      const auto use = std::ranges::lower_bound(uses, std::pair(vertexOf(c), groups_.of(c)));
      part_.triangles[c / 3][static_cast<int>(c % 3)] = places[static_cast<std::size_t>(use - uses.begin())];
    }
  }

  MeshPart& part_;
  std::vector<vec2> uvs_;
  std::size_t corners_;
  std::vector<FaceFrame> faces_;
  std::vector<glm::dvec3> faceNormals_;  // where the part has none
  std::vector<Corner> welded_;           // by corner: equal for vertices that are one
  Groups<Corner> groups_;                // that share a tangent
};

}  // namespace

void computeTangents(MeshPart& part, const Texture& texture) {
  const std::vector<vec2>& uvs = texture.uvSet == 0 ? part.uv0 : part.uv1;
  if (uvs.empty()) return;
  TangentSpace(part, texture, uvs).compute();
}

}  // namespace importon
