#include "render/device_scene/instances.h"

#include <algorithm>
#include <bit>

#include "accel/two_level.h"
#include "scene/materials/material_table.h"

namespace importon {
namespace {

/// Of the rounding of a placed vertex, over what its terms add up to; three products and three sums round, and the
/// result to a float of the box.
constexpr double kRounding = 8.0 / (1 << 24);

/// m: no coordinate of the placed mesh is greater, nor is a sum of the terms that make it.
glm::dvec3 reachOf(const PlacedMesh& mesh, const Placement& placement) {
  glm::dvec3 most(0.0);
  for (const MeshPage& page : mesh.pages)
    most = glm::max(most, glm::max(glm::abs(glm::dvec3(page.low)), glm::abs(glm::dvec3(page.high))));
  return glm::abs(placement.linear[0]) * most.x + glm::abs(placement.linear[1]) * most.y +
         glm::abs(placement.linear[2]) * most.z + glm::abs(placement.translation);
}

Box boxOf(const PlacedMesh& mesh, const Placement& placement) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const MeshPage& page : mesh.pages) placement.includeBox(page.low, page.high, low, high);
  const glm::dvec3 margin = kRounding * reachOf(mesh, placement);
  return {toFloat4(vec3(low - margin)), toFloat4(vec3(high + margin))};
}

InstanceData dataOf(const PlacedInstance& instance, const PlacedMesh& mesh, std::uint32_t root) {
  const Placement placement = instance.placement();
  const glm::dmat3 back = glm::inverse(placement.linear);
  const glm::dvec3 backwards = -(back * placement.translation);
  InstanceData data{};
  for (int row = 0; row < 3; ++row) {
    data.renderFromObject[row] = instance.renderFromObject[static_cast<std::size_t>(row)];
    data.objectFromRender[row] = vec4(glm::dvec4(back[0][row], back[1][row], back[2][row], backwards[row]));
  }
  data.reach = vec3(reachOf(mesh, placement) * (1 + kRounding));
  data.firstNumber = kPlacedTriangle + instance.firstPage * kPageTriangles;
  data.firstTriangle = mesh.firstTriangle;
  data.root = root;
  data.isMirrored = glm::determinant(placement.linear) < 0;
  return data;
}

InstanceData worldData() {
  InstanceData data{};
  for (int row = 0; row < 3; ++row) {
    data.renderFromObject[row][row] = 1;
    data.objectFromRender[row][row] = 1;
  }
  return data;
}

}  // namespace

Bvh buildSceneTree(const Scene& scene, BvhOptions options) {
  // What a pane lets through is multiplied each time that a ray meets it.
  options.staysWhole = [&](const Triangle& t) { return material_table::isPane(scene.materials[t.material]); };
  if (scene.placed.isEmpty()) return buildBvh(scene.positions, scene.triangles, options);
  PlacedTrees trees{scene.positions, scene.worldTriangles(), {}, {}};
  for (const PlacedMesh& mesh : scene.placed.meshes)
    trees.meshes.push_back(
        {mesh.firstTriangle, std::span(scene.triangles).subspan(mesh.firstTriangle, mesh.triangleCount)});
  for (const PlacedInstance& instance : scene.placed.instances)
    trees.instances.push_back(boxOf(scene.placed.meshes[instance.mesh], instance.placement()));
  return buildTwoLevelBvh(trees, options);
}

std::vector<uvec4> packInstances(const PlacedMeshes& placed, std::span<const std::uint32_t> roots) {
  static_assert(sizeof(InstanceData) == kInstanceTexels * sizeof(uvec4));
  std::vector<uvec4> texels;
  texels.reserve(kInstanceTexels * (placed.instances.size() + 1));
  const auto add = [&](const InstanceData& data) {
    const auto words = std::bit_cast<std::array<uvec4, kInstanceTexels>>(data);
    texels.insert(texels.end(), words.begin(), words.end());
  };
  add(worldData());
  for (const PlacedInstance& instance : placed.instances)
    add(dataOf(instance, placed.meshes[instance.mesh], roots[instance.mesh]));
  return texels;
}

std::vector<uint> instancesOfPages(const PlacedMeshes& placed) {
  std::vector<uint> pages;
  pages.reserve(placed.pageCount());
  for (uint i = 0; i < placed.instances.size(); ++i)
    pages.insert(pages.end(), placed.meshes[placed.instances[i].mesh].pages.size(), i + 1);
  return pages;
}

}  // namespace importon
