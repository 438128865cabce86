#include "scene/meshes/gltf_skin.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/meshes/gltf_accessor.h"

namespace importon {
namespace {

glm::dmat4 vertexMatrix(const MeshPart& part, const SkinPose& pose, std::size_t vertex, const GltfSource& source) {
  glm::dmat4 sum(0.0);
  double weights = 0;
  for (const JointSet& set : part.jointSets) {
    for (int k = 0; k < 4; ++k) {
      const double weight = set.weights[vertex][k];
      if (!(weight > 0)) continue;
      const auto joint = static_cast<double>(set.joints[vertex][k]);
      if (!(joint >= 0 && joint < static_cast<double>(pose.worldFromObject.size()))) {
        throw SceneError(
            fmt::format("joint {} of a vertex is not among the {} of the skin", joint, pose.worldFromObject.size()),
            source.at(pose.pointer + "/joints"), kExportAgain);
      }
      sum += pose.worldFromObject[static_cast<std::size_t>(joint)] * weight;
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : pose.worldFromObject[0];
}

/// As for rigid instances: cofactors for normals, and a mirroring matrix turns the winding and the bitangent.
void moveVertex(MeshPart& part, std::size_t i, const glm::dmat4& worldFromObject, bool isMirrored) {
  const glm::dmat3 linear(worldFromObject);
  part.positions[i] = vec3(linear * glm::dvec3(part.positions[i]) + glm::dvec3(worldFromObject[3]));
  if (!part.normals.empty()) {
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    part.normals[i] = vec3(cofactors * glm::dvec3(part.normals[i])) * (isMirrored ? -1.0f : 1.0f);
  }
  if (!part.tangents.empty()) {
    const vec4 tangent = part.tangents[i];
    part.tangents[i] = vec4(vec3(linear * glm::dvec3(tangent)), isMirrored ? -tangent.w : tangent.w);
  }
}

}  // namespace

SkinPose readSkinPose(const GltfDocument& document, std::size_t skinIndex,
                      std::span<const PlacedNode* const> placedNodes) {
  const tinygltf::Skin& skin = document.model.skins[skinIndex];
  SkinPose pose;
  pose.pointer = fmt::format("/skins/{}", skinIndex);
  std::vector<glm::mat4> inverseBind(skin.joints.size(), glm::mat4(1.0f));
  if (skin.inverseBindMatrices >= 0) {
    inverseBind = readMatrices(document, skin.inverseBindMatrices, pose.pointer + "/inverseBindMatrices");
  }
  if (skin.joints.empty() || inverseBind.size() < skin.joints.size()) {
    throw SceneError(fmt::format("{} joints have {} inverse bind matrices", skin.joints.size(), inverseBind.size()),
                     document.source.at(pose.pointer), kExportAgain);
  }
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const PlacedNode* joint = placedNodes[static_cast<std::size_t>(skin.joints[i])];
    if (joint == nullptr) {
      throw SceneError("the joint is not in the scene",
                       document.source.at(fmt::format("{}/joints/{}", pose.pointer, i)), kExportAgain);
    }
    pose.worldFromObject.push_back(joint->worldFromObject * glm::dmat4(inverseBind[i]));
  }
  return pose;
}

MeshPart posePart(const MeshPart& part, const SkinPose& pose, const GltfSource& source) {
  MeshPart posed = part;
  std::vector<bool> isMirrored(part.positions.size());
  for (std::size_t i = 0; i < part.positions.size(); ++i) {
    const glm::dmat4 worldFromObject = vertexMatrix(part, pose, i, source);
    isMirrored[i] = glm::determinant(glm::dmat3(worldFromObject)) < 0;
    moveVertex(posed, i, worldFromObject, isMirrored[i]);
  }
  for (uvec3& triangle : posed.triangles) {
    if (isMirrored[triangle.x]) std::swap(triangle.y, triangle.z);
  }
  return posed;
}

}  // namespace importon
