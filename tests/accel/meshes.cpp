#include "accel/meshes.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace importon::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Uniform numbers, the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 8) * 0x1p-24; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(unit() * static_cast<double>(n)); }
  vec3 cube() {
    const double x = unit(), y = unit(), z = unit();
    return vec3(glm::dvec3(x, y, z));
  }
  vec3 direction() {
    const double z = 2 * unit() - 1, phi = 2 * std::numbers::pi * unit(), r = std::sqrt(1 - z * z);
    return vec3(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
  }

 private:
  std::mt19937 engine_;
};

struct Bounds {
  vec3 low{kInfinity}, high{-kInfinity};
  [[nodiscard]] float size() const { return glm::length(high - low); }
};

Bounds boundsOf(const Mesh& mesh) {
  Bounds bounds;
  for (const vec3& p : mesh.positions) {
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
  }
  return bounds;
}

struct SurfacePoint {
  vec3 position, normal;
};

/// A point on a random triangle, moved off the surface to a random side, which `normal` faces.
SurfacePoint surfacePoint(const Mesh& mesh, Random& random, float distance) {
  const std::size_t t = random.below(mesh.triangles.size());
  const vec3 a = mesh.vertex(t, 0), b = mesh.vertex(t, 1), c = mesh.vertex(t, 2);
  const auto r = static_cast<float>(std::sqrt(random.unit())), s = static_cast<float>(random.unit());
  const vec3 normal = glm::normalize(glm::cross(b - a, c - a)) * (random.unit() < 0.5 ? -1.0f : 1.0f);
  return {a * (1 - r) + b * (r * (1 - s)) + c * (r * s) + normal * distance, normal};
}

/// A point in a box three times the mesh's.
vec3 pointAround(const Bounds& bounds, Random& random) {
  return bounds.low + (random.cube() * 3.0f - 1.0f) * (bounds.high - bounds.low);
}

}  // namespace

void Mesh::add(vec3 a, vec3 b, vec3 c) {
  const auto first = static_cast<uint>(positions.size());
  positions.insert(positions.end(), {a, b, c});
  triangles.push_back({first, first + 1, first + 2, 0});
}

vec3 Mesh::vertex(std::size_t triangle, int corner) const {
  const Triangle& t = triangles[triangle];
  return positions[corner == 0 ? t.v0 : corner == 1 ? t.v1 : t.v2];
}

Mesh randomTriangles(std::size_t count, float size, std::uint32_t seed) {
  Random random(seed);
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 centre = random.cube();
    const vec3 a = random.cube() - 0.5f, b = random.cube() - 0.5f, c = random.cube() - 0.5f;
    mesh.add(centre + size * a, centre + size * b, centre + size * c);
  }
  return mesh;
}

Mesh slats(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  Mesh mesh = randomTriangles(10 * count, 0.005f, seed);
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 start = random.cube(), along = 0.6f * random.direction();
    const vec3 across = 0.01f * glm::normalize(glm::cross(along, random.direction()));
    mesh.add(start, start + along, start + across);
  }
  return mesh;
}

Mesh heightField(std::uint32_t cells) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x) {
      const double u = static_cast<double>(x) / cells, v = static_cast<double>(y) / cells;
      mesh.positions.emplace_back(glm::dvec3(u, v, 0.1 * std::sin(9 * u) * std::cos(7 * v)));
    }
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const uint a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.push_back({a, b, c, 0});
      mesh.triangles.push_back({b, d, c, 0});
    }
  return mesh;
}

Mesh closedBox(vec3 low, vec3 high) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                (corner & 4) != 0 ? high.z : low.z);
  const auto quad = [&](uint a, uint b, uint c, uint d) {
    mesh.triangles.push_back({a, b, c, 0});
    mesh.triangles.push_back({a, c, d, 0});
  };
  quad(0, 2, 3, 1);
  quad(4, 5, 7, 6);
  quad(0, 1, 5, 4);
  quad(2, 6, 7, 3);
  quad(0, 4, 6, 2);
  quad(1, 3, 7, 5);
  return mesh;
}

Mesh closedSphere(vec3 centre, float radius, uint rings) {
  Mesh mesh;
  const uint segments = 2 * rings;
  mesh.positions = {centre + vec3(0, 0, radius), centre - vec3(0, 0, radius)};
  for (uint ring = 1; ring < rings; ++ring)
    for (uint segment = 0; segment < segments; ++segment) {
      const double theta = std::numbers::pi * ring / rings, phi = 2 * std::numbers::pi * segment / segments;
      const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      mesh.positions.push_back(centre + radius * vec3(n));
    }
  const auto vertex = [&](uint ring, uint segment) {
    return ring == 0 ? 0u : ring == rings ? 1u : 2 + (ring - 1) * segments + segment % segments;
  };
  for (uint ring = 0; ring < rings; ++ring)
    for (uint segment = 0; segment < segments; ++segment) {
      const uint a = vertex(ring, segment), b = vertex(ring + 1, segment), c = vertex(ring + 1, segment + 1),
                 d = vertex(ring, segment + 1);
      if (ring + 1 < rings) mesh.triangles.push_back({a, b, c, 0});
      if (ring > 0) mesh.triangles.push_back({a, c, d, 0});
    }
  return mesh;
}

std::vector<Ray> surfaceRays(const Mesh& mesh, std::size_t count, std::uint32_t seed) {
  Random random(seed);
  const float distance = 1e-5f * boundsOf(mesh).size();
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePoint from = surfacePoint(mesh, random, distance);
    const vec3 direction = random.direction();
    const bool isLeaving = glm::dot(direction, from.normal) > 0.0f;
    rays.push_back({from.position, kInfinity, isLeaving ? direction : -direction, static_cast<uint>(i)});
  }
  return rays;
}

std::vector<Ray> segmentRays(const Mesh& mesh, std::size_t count, std::uint32_t seed) {
  Random random(seed);
  const float distance = 1e-5f * boundsOf(mesh).size();
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 from = surfacePoint(mesh, random, distance).position;
    const vec3 to = surfacePoint(mesh, random, distance).position;
    const float length = glm::length(to - from);
    rays.push_back({from, length, (to - from) / length, static_cast<uint>(i)});
  }
  return rays;
}

std::vector<Ray> axisRays(const Mesh& mesh, std::size_t count, std::uint32_t seed) {
  Random random(seed);
  const Bounds bounds = boundsOf(mesh);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    vec3 direction(0.0f);
    direction[static_cast<int>(i % 3)] = (i / 3) % 2 == 0 ? 1.0f : -1.0f;
    vec3 origin = pointAround(bounds, random);
    // Half of them in line with a vertex: on the faces of boxes, through edges and corners.
    if (i % 2 == 0) {
      const vec3 vertex = mesh.positions[random.below(mesh.positions.size())];
      origin = vertex - direction * (bounds.size() * static_cast<float>(0.5 + random.unit()));
    }
    rays.push_back({origin, kInfinity, direction, static_cast<uint>(i)});
  }
  return rays;
}

std::vector<Ray> grazingRays(const Mesh& mesh, std::size_t count, std::uint32_t seed) {
  Random random(seed);
  const Bounds bounds = boundsOf(mesh);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t t = random.below(mesh.triangles.size());
    const int corner = static_cast<int>(random.below(3));
    const vec3 a = mesh.vertex(t, corner), b = mesh.vertex(t, (corner + 1) % 3);
    const vec3 target = i % 2 == 0 ? a : a + (b - a) * static_cast<float>(random.unit());
    const vec3 origin = pointAround(bounds, random);
    rays.push_back({origin, kInfinity, glm::normalize(target - origin), static_cast<uint>(i)});
  }
  return rays;
}

}  // namespace importon::test
