#include "scene/meshes/tangents.h"

namespace importon {
namespace {

/// Sums over the triangles of a vertex, weighted by area.
struct Frame {
  glm::dvec3 tangent{0.0};
  double handedness = 0;
};

glm::dvec2 transformed(const vec2& uv, const Texture& texture) {
  const vec3 homogeneous(uv, 1.0f);
  return {glm::dot(texture.uvRow0, homogeneous), glm::dot(texture.uvRow1, homogeneous)};
}

/// The unit direction of growing u in a triangle [Lengyel 2001, Computing Tangent Space Basis Vectors for an
/// Arbitrary Mesh], times the triangle's doubled area; the sign of its UV area. Zero if it has none.
Frame triangleFrame(const glm::dvec3 (&p)[3], const glm::dvec2 (&uv)[3]) {
  const glm::dvec3 e1 = p[1] - p[0];
  const glm::dvec3 e2 = p[2] - p[0];
  const glm::dvec2 d1 = uv[1] - uv[0];
  const glm::dvec2 d2 = uv[2] - uv[0];
  const double uvArea = d1.x * d2.y - d2.x * d1.y;
  const double area = glm::length(glm::cross(e1, e2));
  const double sign = uvArea < 0 ? -1.0 : 1.0;
  const glm::dvec3 tangent = (e1 * d2.y - e2 * d1.y) * sign;
  const double length = glm::length(tangent);
  if (uvArea == 0 || !(length > 0) || !std::isfinite(length) || !std::isfinite(area)) return {};
  // Green of a normal map points up and v down: the bitangent, w cross(normal, tangent), runs against v.
  return {tangent * (area / length), -area * sign};
}

}  // namespace

void computeTangents(MeshPart& part, const Texture& texture) {
  const std::vector<vec2>& uvs = texture.uvSet == 0 ? part.uv0 : part.uv1;
  if (uvs.empty()) return;
  std::vector<Frame> frames(part.positions.size());
  for (const uvec3& triangle : part.triangles) {
    const glm::dvec3 p[3] = {part.positions[triangle.x], part.positions[triangle.y], part.positions[triangle.z]};
    const glm::dvec2 uv[3] = {transformed(uvs[triangle.x], texture), transformed(uvs[triangle.y], texture),
                              transformed(uvs[triangle.z], texture)};
    const Frame frame = triangleFrame(p, uv);
    for (int corner = 0; corner < 3; ++corner) {
      frames[triangle[corner]].tangent += frame.tangent;
      frames[triangle[corner]].handedness += frame.handedness;
    }
  }
  part.tangents.resize(part.positions.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    glm::dvec3 tangent = frames[i].tangent;
    if (!part.normals.empty()) {
      const glm::dvec3 normal(part.normals[i]);
      const double squared = glm::dot(normal, normal);
      if (squared > 0) tangent -= normal * (glm::dot(normal, tangent) / squared);
    }
    const double length = glm::length(tangent);
    const bool isUsable = length > 1e-6 * glm::length(frames[i].tangent) && std::isfinite(length);
    part.tangents[i] = vec4(isUsable ? vec3(tangent / length) : vec3(0.0f), frames[i].handedness < 0 ? -1.0f : 1.0f);
  }
}

}  // namespace importon
