#include "support/scene_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "scene/geometry.h"
#include "scene/lights.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

constexpr double kPi = glm::pi<double>();

struct IndexedTriangle {
  uint a, b, c;
};

/// Directions of a unit icosahedron's corners and its faces, counter-clockwise from outside.
const std::vector<glm::dvec3>& icosahedronCorners() {
  static const double g = glm::golden_ratio<double>();
  static const std::vector<glm::dvec3> corners = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                                  {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                                  {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  return corners;
}

std::vector<IndexedTriangle> icosahedronFaces() {
  return {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
          {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
          {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
}

/// Splits each triangle of directions in four; new corners are shared.
std::vector<IndexedTriangle> splitInFour(const std::vector<IndexedTriangle>& triangles,
                                         std::vector<glm::dvec3>& directions) {
  std::map<std::pair<uint, uint>, uint> middles;
  const auto between = [&](uint a, uint b) {
    const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<uint>(directions.size()));
    if (isNew) directions.push_back(glm::normalize(directions[a] + directions[b]));
    return entry->second;
  };
  std::vector<IndexedTriangle> result;
  for (const auto& [a, b, c] : triangles) {
    const uint ab = between(a, b), bc = between(b, c), ca = between(c, a);
    result.insert(result.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return result;
}

vec2 sphereUv(const glm::dvec3& direction) {
  return {static_cast<float>(0.5 + std::atan2(direction.z, direction.x) / (2 * kPi)),
          static_cast<float>(std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi)};
}

}  // namespace

void tangentFrame(const glm::dvec3& normal, glm::dvec3& tangent, glm::dvec3& bitangent) {
  const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  tangent = glm::normalize(glm::cross(other, normal));
  bitangent = glm::cross(normal, tangent);
}

uint SceneBuilder::material(const Material& definition, const std::string& name) {
  materials_.push_back(definition);
  names_.push_back(name);
  return static_cast<uint>(materials_.size() - 1);
}

uint SceneBuilder::vertex(const glm::dvec3& position, const glm::dvec3& normal, const vec2& uv) {
  positions_.push_back(position);
  normals_.push_back(normal);
  uvs_.push_back(uv);
  return static_cast<uint>(positions_.size() - 1);
}

void SceneBuilder::triangle(uint material, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  assert(material < materials_.size());
  const glm::dvec3 none(0.0);
  const uint first = vertex(a, none, {0, 0});
  vertex(b, none, {1, 0});
  vertex(c, none, {0, 1});
  triangles_.push_back({first, first + 1, first + 2, material});
}

void SceneBuilder::quad(uint material, const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV,
                        int columns, int rows) {
  assert(material < materials_.size() && columns > 0 && rows > 0);
  const auto first = static_cast<uint>(positions_.size());
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns, v = static_cast<double>(j) / rows;
      vertex(corner + u * edgeU + v * edgeV, glm::dvec3(0.0), {static_cast<float>(u), static_cast<float>(v)});
    }
  }
  const auto width = static_cast<uint>(columns + 1);
  for (uint j = 0; j < static_cast<uint>(rows); ++j) {
    for (uint i = 0; i < static_cast<uint>(columns); ++i) {
      const uint a = first + j * width + i;
      triangles_.push_back({a, a + 1, a + width + 1, material});
      triangles_.push_back({a, a + width + 1, a + width, material});
    }
  }
}

void SceneBuilder::square(uint material, const glm::dvec3& center, const glm::dvec3& normal, double side, int cells) {
  glm::dvec3 tangent, bitangent;
  tangentFrame(glm::normalize(normal), tangent, bitangent);
  quad(material, center - 0.5 * side * (tangent + bitangent), side * tangent, side * bitangent, cells, cells);
}

void SceneBuilder::disc(uint material, const glm::dvec3& center, const glm::dvec3& normal, double radius,
                        int segments) {
  assert(material < materials_.size() && segments > 2);
  glm::dvec3 tangent, bitangent;
  tangentFrame(glm::normalize(normal), tangent, bitangent);
  const uint middle = vertex(center, glm::dvec3(0.0), {0.5f, 0.5f});
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * kPi * i / segments, c = std::cos(angle), s = std::sin(angle);
    vertex(center + radius * (c * tangent + s * bitangent), glm::dvec3(0.0),
           {static_cast<float>(0.5 + 0.5 * c), static_cast<float>(0.5 + 0.5 * s)});
  }
  const auto count = static_cast<uint>(segments);
  for (uint i = 0; i < count; ++i) {
    triangles_.push_back({middle, middle + 1 + i, middle + 1 + (i + 1) % count, material});
  }
}

void SceneBuilder::box(uint material, const glm::dvec3& low, const glm::dvec3& high, Facing facing, int cells) {
  const glm::dvec3 size = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 edges[2] = {glm::dvec3(0.0), glm::dvec3(0.0)};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    edges[0][u] = size[u];
    edges[1][v] = size[v];
    glm::dvec3 onHighSide = low;
    onHighSide[axis] = high[axis];
    const int first = facing == Facing::outside ? 0 : 1;  // edges[0] x edges[1] points along +axis
    quad(material, onHighSide, edges[first], edges[1 - first], cells, cells);
    quad(material, low, edges[1 - first], edges[first], cells, cells);
  }
}

void SceneBuilder::sphereTriangle(uint material, uint a, uint b, uint c, Facing facing) {
  if (facing == Facing::inside) std::swap(b, c);
  triangles_.push_back({a, b, c, material});
}

void SceneBuilder::uvSphere(uint material, const glm::dvec3& center, double radius, int rings, int segments,
                            Facing facing, Shading shading) {
  assert(material < materials_.size() && rings > 1 && segments > 2);
  const double side = facing == Facing::outside ? 1.0 : -1.0;
  const auto first = static_cast<uint>(positions_.size());
  for (int j = 0; j <= rings; ++j) {
    const double theta = kPi * j / rings;
    for (int i = 0; i <= segments; ++i) {
      const double phi = i == segments ? 0.0 : 2 * kPi * i / segments;
      const bool isPole = j == 0 || j == rings;
      const double sine = isPole ? 0.0 : std::sin(theta);
      const glm::dvec3 direction(sine * std::cos(phi), isPole ? 1.0 - 2.0 * (j != 0) : std::cos(theta),
                                 sine * std::sin(phi));
      vertex(center + radius * direction, shading == Shading::smooth ? side * direction : glm::dvec3(0.0),
             {static_cast<float>(i) / static_cast<float>(segments), static_cast<float>(j) / static_cast<float>(rings)});
    }
  }
  const auto width = static_cast<uint>(segments + 1), last = static_cast<uint>(rings - 1);
  for (uint j = 0; j <= last; ++j) {
    for (uint i = 0; i + 1 < width; ++i) {
      const uint a = first + j * width + i;
      if (j > 0) sphereTriangle(material, a, a + 1, a + width, facing);
      if (j < last) sphereTriangle(material, a + 1, a + width + 1, a + width, facing);
    }
  }
}

void SceneBuilder::icosphere(uint material, const glm::dvec3& center, double radius, int subdivisions, Facing facing,
                             Shading shading) {
  assert(material < materials_.size() && subdivisions >= 0);
  std::vector<glm::dvec3> directions;
  for (const glm::dvec3& corner : icosahedronCorners()) directions.push_back(glm::normalize(corner));
  std::vector<IndexedTriangle> faces = icosahedronFaces();
  for (int i = 0; i < subdivisions; ++i) faces = splitInFour(faces, directions);
  const double side = facing == Facing::outside ? 1.0 : -1.0;
  const auto first = static_cast<uint>(positions_.size());
  for (const glm::dvec3& direction : directions) {
    vertex(center + radius * direction, shading == Shading::smooth ? side * direction : glm::dvec3(0.0),
           sphereUv(direction));
  }
  for (const auto& [a, b, c] : faces) sphereTriangle(material, first + a, first + b, first + c, facing);
}

void SceneBuilder::pointLight(const glm::dvec3& position, const vec3& intensity) {
  Light light{};
  light.kind = kLightPoint;
  light.triangle = kNone;
  light.emission = intensity;
  light.power = pointPower(intensity);
  lights_.push_back({light, position, {0, -1, 0}});
}

void SceneBuilder::spotLight(const glm::dvec3& position, const glm::dvec3& direction, const vec3& intensity,
                             double inner, double outer) {
  assert(inner >= 0 && inner < outer && outer <= kPi / 2);
  Light light{};
  light.kind = kLightSpot;
  light.triangle = kNone;
  light.emission = intensity;
  light.cosInner = static_cast<float>(std::cos(inner));
  light.cosOuter = static_cast<float>(std::cos(outer));
  light.power = spotPower(intensity, light.cosInner, light.cosOuter);
  lights_.push_back({light, position, direction});
}

void SceneBuilder::directionalLight(const glm::dvec3& direction, const vec3& irradiance) {
  Light light{};
  light.kind = kLightDirectional;
  light.triangle = kNone;
  light.emission = irradiance;
  lights_.push_back({light, glm::dvec3(0.0), direction});
}

void SceneBuilder::environment(const vec3& radiance) { environment_ = EnvironmentMap{1, 1, {radiance}}; }

void SceneBuilder::camera(const glm::dvec3& position, const glm::dvec3& target, double yfov, int width, int height,
                          const glm::dvec3& up) {
  const glm::dvec3 back = glm::normalize(position - target);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  Camera camera;
  camera.name = "camera " + std::to_string(cameras_.size());
  camera.yfov = yfov;
  camera.aspectRatio = static_cast<double>(width) / height;
  camera.width = width;
  camera.height = height;
  camera.worldFromCamera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0), glm::dvec4(back, 0),
                                      glm::dvec4(position, 1));
  cameras_.push_back(camera);
}

Scene SceneBuilder::finish() const {
  if (triangles_.empty()) throw std::logic_error("SceneBuilder: the scene has no triangle");
  Scene scene;
  scene.file = "scene made by a test";
  scene.materials = materials_;
  scene.materialNames = names_;
  scene.triangles = triangles_;
  placeVertices(scene);
  placeLights(scene);
  placeCameras(scene);
  return scene;
}

void SceneBuilder::placeVertices(Scene& scene) const {
  std::vector<glm::dvec3> world;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& position : positions_) {
    world.emplace_back(worldFromBuilt_ * glm::dvec4(position, 1));
    low = glm::min(low, world.back());
    high = glm::max(high, world.back());
  }
  scene.worldFromRender = chooseOrigin(low, high);
  const uvec2 white = packColor(vec4(1.0f));
  scene.boundsMin = vec3(std::numeric_limits<float>::infinity());
  scene.boundsMax = -scene.boundsMin;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const vec3 position(world[i] - scene.worldFromRender);
    scene.positions.push_back(position);
    scene.boundsMin = glm::min(scene.boundsMin, position);
    scene.boundsMax = glm::max(scene.boundsMax, position);
    const bool hasNormal = normals_[i] != glm::dvec3(0.0);
    const glm::dvec3 normal = glm::dmat3(worldFromBuilt_) * normals_[i];
    const uint packedNormal = hasNormal ? packNormal(glm::normalize(normal)) : kNone;
    scene.vertices.push_back({uvs_[i], uvs_[i], packedNormal, kNone, white.x, white.y});
  }
}

void SceneBuilder::placeLights(Scene& scene) const {
  addEmissiveTriangles(scene);
  const float radius = boundingSphere(scene).radius;
  for (const PunctualLight& built : lights_) {
    Light light = built.light;
    light.position = vec3(glm::dvec3(worldFromBuilt_ * glm::dvec4(built.position, 1)) - scene.worldFromRender);
    light.direction = vec3(glm::normalize(glm::dmat3(worldFromBuilt_) * built.direction));
    if (light.kind == kLightDirectional) light.power = directionalPower(light.emission, radius);
    scene.lights.push_back(light);
  }
  scene.environment = environment_;
  addEnvironmentLight(scene);
}

void SceneBuilder::placeCameras(Scene& scene) const {
  for (Camera camera : cameras_) {
    camera.worldFromCamera = worldFromBuilt_ * camera.worldFromCamera;
    for (int axis = 0; axis < 3; ++axis) {
      camera.worldFromCamera[axis] = glm::dvec4(glm::normalize(glm::dvec3(camera.worldFromCamera[axis])), 0);
    }
    scene.cameras.push_back(camera);
  }
  scene.hasCameraInFile = !cameras_.empty();
}

}  // namespace importon::test
