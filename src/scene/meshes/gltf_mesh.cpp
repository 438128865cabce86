#include "scene/meshes/gltf_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/meshes/gltf_accessor.h"
#include "scene/meshes/triangulate.h"

namespace importon {
namespace {

/// Reads the attributes of one primitive.
class PartReader {
 public:
  PartReader(const GltfDocument& document, const tinygltf::Primitive& primitive, std::string pointer, Log& log)
      : document_(document), primitive_(primitive), pointer_(std::move(pointer)), log_(log) {}

  MeshPart read(const std::vector<double>& weights) {
    vertexCount_ = vertexCount();
    MeshPart part;
    if (vertexCount_ == 0) return part;
    part.material = primitive_.material;
    part.positions = attribute<3>("POSITION");
    part.normals = attribute<3>("NORMAL");
    part.tangents = attribute<4>("TANGENT");
    part.uv0 = attribute<2>("TEXCOORD_0");
    part.uv1 = attribute<2>("TEXCOORD_1");
    part.colors = attribute<4>("COLOR_0");
    part.jointSets = readJointSets();
    morph(part, weights);
    part.triangles = readTriangles();
    return part;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& rest) const {
    throw SceneError(what, document_.source.at(pointer_ + rest), kExportAgain);
  }

  /// 0 where there is nothing to draw, which is told.
  [[nodiscard]] std::size_t vertexCount() const {
    const auto skip = [&](const char* what) {
      document_.faults.forgive("primitive without vertices", pointer_ + "/attributes", what,
                               "the primitive is passed over");
      return std::size_t{0};
    };
    const auto position = primitive_.attributes.find("POSITION");
    if (position == primitive_.attributes.end()) return skip("POSITION is missing");
    const std::size_t count = countOf(position->second);
    if (count == 0) return skip("POSITION has no elements");
    return primitive_.indices >= 0 && countOf(primitive_.indices) == 0 ? skip("there are no indices") : count;
  }

  [[nodiscard]] std::size_t countOf(int accessor) const {
    return document_.model.accessors[static_cast<std::size_t>(accessor)].count;
  }

  template <int N>
  std::vector<glm::vec<N, float>> values(const std::map<std::string, int>& attributes, const char* name,
                                         const std::string& place) const {
    const auto entry = attributes.find(name);
    if (entry == attributes.end()) return {};
    const std::size_t count = countOf(entry->second);
    if (count != vertexCount_) {
      fail(fmt::format("{} has {} elements but POSITION has {}", name, count, vertexCount_), place);
    }
    return readFloats<N>(document_, entry->second, pointer_ + place);
  }

  template <int N>
  std::vector<glm::vec<N, float>> attribute(const char* name) const {
    return values<N>(primitive_.attributes, name, std::string("/attributes/") + name);
  }

  [[nodiscard]] std::vector<JointSet> readJointSets() const {
    std::vector<JointSet> sets;
    for (int n = 0;; ++n) {
      const std::string joints = fmt::format("JOINTS_{}", n), weights = fmt::format("WEIGHTS_{}", n);
      const bool hasJoints = primitive_.attributes.contains(joints),
                 hasWeights = primitive_.attributes.contains(weights);
      if (!hasJoints && !hasWeights) return sets;
      if (hasJoints && hasWeights) {
        sets.push_back({attribute<4>(joints.c_str()), attribute<4>(weights.c_str())});
      } else {
        document_.faults.forgive("joints without weights", pointer_ + "/attributes",
                                 fmt::format("{} is missing", hasJoints ? weights : joints),
                                 "this set of joints is passed over");
      }
    }
  }

  /// Adds the weighted displacements of a morph target; those of an attribute that the primitive lacks go.
  template <int N, int M>
  void displace(std::vector<glm::vec<N, float>>& base, std::size_t target, const char* name, float weight) const {
    if (base.empty()) return;
    const std::string place = fmt::format("/targets/{}/{}", target, name);
    const std::vector<glm::vec<M, float>> change = values<M>(primitive_.targets[target], name, place);
    for (std::size_t i = 0; i < change.size(); ++i) {
      for (int c = 0; c < M; ++c) base[i][c] += weight * change[i][c];
    }
  }

  void morph(MeshPart& part, const std::vector<double>& weights) const {
    for (std::size_t target = 0; target < std::min(primitive_.targets.size(), weights.size()); ++target) {
      const auto weight = static_cast<float>(weights[target]);
      if (weight == 0) continue;
      displace<3, 3>(part.positions, target, "POSITION", weight);
      displace<3, 3>(part.normals, target, "NORMAL", weight);
      displace<4, 3>(part.tangents, target, "TANGENT", weight);
      displace<2, 2>(part.uv0, target, "TEXCOORD_0", weight);
      displace<2, 2>(part.uv1, target, "TEXCOORD_1", weight);
      displace<4, 4>(part.colors, target, "COLOR_0", weight);
    }
  }

  std::vector<uvec3> readTriangles() const {
    const auto mode = static_cast<TriangleMode>(primitive_.mode);
    if (primitive_.indices < 0) {
      warnOfRest(mode, vertexCount_);
      return triangulate(mode, vertexCount_);
    }
    const std::string place = pointer_ + "/indices";
    std::vector<uint> indices = readIndices(document_, primitive_.indices, place);
    const uint largest = *std::max_element(indices.begin(), indices.end());
    if (largest >= vertexCount_ && largest == restartIndex()) return trianglesBetweenRestarts(mode, indices);
    checkIndices(indices);
    warnOfRest(mode, indices.size());
    return triangulate(mode, indices);
  }

  void checkIndices(const std::vector<uint>& indices) const {
    for (const uint index : indices) {
      if (index < vertexCount_) continue;
      fail(fmt::format("index {} is not among the {} vertices", index, vertexCount_), "/indices");
    }
  }

  /// The largest value of the indices' type, which starts a primitive anew in other formats.
  [[nodiscard]] uint restartIndex() const {
    switch (document_.model.accessors[static_cast<std::size_t>(primitive_.indices)].componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 0xFFu;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 0xFFFFu;
      default:
        return 0xFFFFFFFFu;
    }
  }

  /// glTF 2.0, section 3.7.2.1, forbids restarts; they are read as other formats mean them.
  [[nodiscard]] std::vector<uvec3> trianglesBetweenRestarts(TriangleMode mode, const std::vector<uint>& indices) const {
    const uint restart = restartIndex();
    document_.faults.forgive("primitive restart", pointer_ + "/indices",
                             fmt::format("index {} is not among the {} vertices", restart, vertexCount_),
                             "it is taken for the start of a new strip");
    std::vector<uvec3> triangles;
    for (auto first = indices.begin(); first != indices.end();) {
      const auto end = std::find(first, indices.end(), restart);
      const std::vector<uint> run(first, end);
      checkIndices(run);
      const std::vector<uvec3> made = triangulate(mode, run);
      triangles.insert(triangles.end(), made.begin(), made.end());
      first = end == indices.end() ? end : end + 1;
    }
    return triangles;
  }

  void warnOfRest(TriangleMode mode, std::size_t corners) const {
    if (corners >= 3 && (mode != TriangleMode::triangles || corners % 3 == 0)) return;
    log_.warn("incomplete triangle", fmt::format("{}: {} corners do not make whole triangles; the rest is passed over",
                                                 document_.source.at(pointer_), corners));
  }

  const GltfDocument& document_;
  const tinygltf::Primitive& primitive_;
  std::string pointer_;
  Log& log_;
  std::size_t vertexCount_ = 0;
};

}  // namespace

uint duplicateVertex(MeshPart& part, uint vertex) {
  const auto duplicate = [vertex](auto&... attributes) {
    ((attributes.empty() ? void() : attributes.push_back(attributes[vertex])), ...);
  };
  duplicate(part.positions, part.normals, part.tangents, part.uv0, part.uv1, part.colors);
  for (JointSet& set : part.jointSets) duplicate(set.joints, set.weights);
  return static_cast<uint>(part.positions.size() - 1);
}

MeshPart partOf(const MeshPart& whole, const std::vector<uvec3>& triangles) {
  MeshPart part;
  part.material = whole.material;
  part.jointSets.resize(whole.jointSets.size());
  std::vector<uint> newIndex(whole.positions.size(), kNone);
  const auto copy = [](auto& to, const auto& from, uint vertex) {
    if (!from.empty()) to.push_back(from[vertex]);
  };
  const auto use = [&](uint vertex) {
    if (newIndex[vertex] != kNone) return newIndex[vertex];
    newIndex[vertex] = static_cast<uint>(part.positions.size());
    copy(part.positions, whole.positions, vertex);
    copy(part.normals, whole.normals, vertex);
    copy(part.tangents, whole.tangents, vertex);
    copy(part.uv0, whole.uv0, vertex);
    copy(part.uv1, whole.uv1, vertex);
    copy(part.colors, whole.colors, vertex);
    for (std::size_t i = 0; i < whole.jointSets.size(); ++i) {
      copy(part.jointSets[i].joints, whole.jointSets[i].joints, vertex);
      copy(part.jointSets[i].weights, whole.jointSets[i].weights, vertex);
    }
    return newIndex[vertex];
  };
  for (const uvec3& t : triangles) part.triangles.emplace_back(use(t.x), use(t.y), use(t.z));
  return part;
}

std::vector<MeshPart> readMesh(const GltfDocument& document, std::size_t mesh, const std::vector<double>& weights,
                               Log& log) {
  std::vector<MeshPart> parts;
  const std::vector<tinygltf::Primitive>& primitives = document.model.meshes[mesh].primitives;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::string pointer = fmt::format("/meshes/{}/primitives/{}", mesh, i);
    if (primitives[i].mode < TINYGLTF_MODE_TRIANGLES) {
      log.warn("points and lines", fmt::format("{}: points and lines are passed over", document.source.at(pointer)));
      continue;
    }
    MeshPart part = PartReader(document, primitives[i], pointer, log).read(weights);
    if (!part.positions.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace importon
