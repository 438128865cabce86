#include "support/placed_scene.h"

#include <cmath>
#include <deque>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "base/log.h"
#include "scene/environment.h"
#include "scene/geometry.h"
#include "scene/lights.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

/// The triangles of a material.
MeshPart partOf(const Scene& scene, uint material) {
  if (scene.worldFromRender != glm::dvec3(0.0)) throw std::invalid_argument("withInstances: far from the origin");
  MeshPart part;
  part.positions = scene.positions;
  const bool hasNormals = !scene.vertices.empty() && scene.vertices.front().normal != kNone;
  for (const Vertex& vertex : scene.vertices) {
    part.uv0.push_back(vertex.uv0);
    if (hasNormals) part.normals.push_back(unpackNormal(vertex.normal));
  }
  for (const Triangle& t : scene.triangles)
    if (t.material == material) part.triangles.emplace_back(t.v0, t.v1, t.v2);
  return part;
}

}  // namespace

Scene withInstances(const Scene& world, const Scene& object, std::span<const glm::dmat4> worldFromObject, Held held) {
  Scene scene;
  scene.file = world.file;
  scene.materials = world.materials;
  scene.materials.insert(scene.materials.end(), object.materials.begin(), object.materials.end());
  std::deque<MeshPart> parts;
  std::vector<MeshInstance> instances;
  const auto add = [&](const Scene& from, std::size_t firstMaterial, std::span<const glm::dmat4> places) {
    for (uint material = 0; material < from.materials.size(); ++material) {
      MeshPart part = partOf(from, material);
      if (part.triangles.empty()) continue;
      parts.push_back(std::move(part));
      const bool emits = (from.materials[material].flags & kMaterialEmissive) != 0;
      for (const glm::dmat4& place : places)
        instances.push_back({&parts.back(), place, static_cast<uint>(firstMaterial + material), emits});
    }
  };
  const glm::dmat4 identity(1.0);
  add(world, 0, std::span(&identity, 1));
  add(object, world.materials.size(), worldFromObject);
  Log log(Log::Verbosity::quiet);
  assembleGeometry(instances, scene, "test", log, {held == Held::once ? 1 : std::numeric_limits<std::size_t>::max()});
  scene.cameras = world.cameras;
  addEmissiveTriangles(scene);
  for (Light light : world.lights) {
    if (light.kind == kLightTriangle || light.kind == kLightEnvironment) continue;
    if (light.kind == kLightDirectional) light.power = directionalPower(light.emission, boundingSphere(scene).radius);
    scene.lights.push_back(light);
  }
  scene.environment = world.environment;
  addEnvironmentLight(scene);
  return scene;
}

std::vector<glm::dmat4> scattered(std::size_t count, double distance, bool isStretched) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto perRow = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double middle = 0.5 * static_cast<double>(perRow - 1);
  std::vector<glm::dmat4> places;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 at((static_cast<double>(i % perRow) - middle) * distance, 0,
                        (static_cast<double>(i / perRow) - middle) * distance);
    const glm::dvec3 axis(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    glm::dvec3 size(0.5 + unit(random));
    if (isStretched) size = glm::dvec3(0.5 + unit(random), 0.5 + unit(random), 0.5 + unit(random));
    if (i % 2 == 1) size.x = -size.x;
    places.push_back(
        glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), at), 6.28 * unit(random), glm::normalize(axis)), size));
  }
  return places;
}

}  // namespace importon::test
