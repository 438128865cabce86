/// A validated scene as plain data, in the layout of the device (shaders/shared/scene_data.h).
#pragma once
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/animation/animation_summary.h"
#include "scene/instances/placed_meshes.h"
#include "shared/scene_data.h"

namespace importon {

/// A glTF camera in the world. Looks along -z of worldFromCamera, y up.
struct Camera {
  std::string name;
  std::string nodeName;
  bool isOrthographic = false;
  double yfov = 0.8;                // radians, perspective
  double aspectRatio = 0;           // 0: not given
  double xmag = 1, ymag = 1;        // half extents in m, orthographic
  glm::dmat4 worldFromCamera{1.0};  // rigid up to handedness; scale removed
  int width = 0, height = 0;        // extras.width/height, 0: not given
  double fStop = 0;                 // extras.fStop: focal length over the lens's diameter; 0: not given
  double focusDistance = 0;         // extras.focusDistance: m, along the view; 0: not given

  /// m, of a perspective camera whose image is as high as that of a 35 mm film.
  [[nodiscard]] double focalLength() const { return 0.5 * kFilmHeight / std::tan(0.5 * yfov); }
  static constexpr double kFilmHeight = 0.024;  // m
  static constexpr double kLeastFStop = 0.01;   // the lens is no larger than numbers hold
};

/// Light from far away, W/(m² sr), over a lat-long map: rows from the top, which is up (+y); the middle looks along
/// -z, the right half to +x. One texel: the same from everywhere.
struct EnvironmentMap {
  int width = 1, height = 1;
  std::vector<vec3> texels;
};

/// Words of texels that a scene may have.
constexpr std::size_t kMostTexels = std::size_t{1} << 28;

/// Everything that a render needs. Triangles come in one list: first those of the world, in render space (world is
/// render plus worldFromRender, with the scene's centre near the origin), then those of meshes that stand in many
/// places, each in its own space. What emits is always of the world.
struct Scene {
  std::filesystem::path file;
  std::vector<vec3> positions;   // per vertex, in the space of its triangles
  std::vector<Vertex> vertices;  // same length as positions
  std::vector<Triangle> triangles;
  PlacedMeshes placed;
  std::vector<Material> materials;  // at least one: the glTF default material stands behind those of the file
  std::vector<std::string> materialNames;
  std::vector<Texture> textures;
  std::vector<uint> texels;           // RGBA8, or RGBA16 (Texture::isDeep)
  std::vector<Light> lights;          // emissive triangles, punctual lights, environment
  std::vector<uint> lightOfTriangle;  // of the world; kNone where a triangle emits nothing; empty if no triangle emits
  std::vector<Camera> cameras;
  glm::dvec3 worldFromRender{0.0};
  vec3 boundsMin{0}, boundsMax{0};  // render space
  std::optional<EnvironmentMap> environment;
  std::vector<std::string> sceneNames, variantNames;  // what the file offers to choose from
  std::vector<AnimationSummary> animations;           // of the file, if they were asked for
  bool isInStudio = false;                            // the environment is that of scene/studio.h
  bool hasCameraInFile = true;                        // false: cameras[0] was made to frame the scene

  [[nodiscard]] std::size_t worldTriangleCount() const {
    return placed.meshes.empty() ? triangles.size() : placed.meshes.front().firstTriangle;
  }
  [[nodiscard]] std::span<const Triangle> worldTriangles() const {
    return std::span(triangles).first(worldTriangleCount());
  }
  /// Those of the world and of all instances.
  [[nodiscard]] std::size_t shownTriangleCount() const {
    std::size_t count = worldTriangleCount();
    for (const PlacedInstance& instance : placed.instances) count += placed.meshes[instance.mesh].triangleCount;
    return count;
  }
};

}  // namespace importon
