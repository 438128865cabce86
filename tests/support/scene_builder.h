/// Small scenes made in memory, for tests whose result is known in closed form.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace importon::test {

/// Which side of a closed surface is its front.
enum class Facing { outside, inside };
/// Flat: vertices without normals. Smooth: the sphere's own normals.
enum class Shading { flat, smooth };

/// Materials. Each function gives a complete Material; SceneBuilder::material adds it.
[[nodiscard]] Material diffuse(const vec3& albedo);  // exactly Lambertian: no specular lobe
/// A black emitter of `radiance` W/(m² sr), or one that also reflects `albedo`.
[[nodiscard]] Material emitter(const vec3& radiance, bool isDoubleSided = false, const vec3& albedo = vec3(0.0f));
[[nodiscard]] Material mirror(const vec3& reflectance = vec3(1.0f));  // a smooth metal
[[nodiscard]] Material metal(const vec3& reflectance, float roughness);
/// A smooth interface of a solid; `absorption` in 1/m.
[[nodiscard]] Material glass(float ior, const vec3& absorption = vec3(0.0f));
/// A thin sheet of glass: what passes goes straight on.
[[nodiscard]] Material thinGlass(float ior);

/// Collects shapes, lights and cameras in world space (m, y up), then makes a Scene of them. Faces are
/// counter-clockwise seen from their front.
class SceneBuilder {
 public:
  /// Adds a material and returns its index, which the shapes take.
  uint material(const Material& definition, const std::string& name = {});

  void triangle(uint material, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
  /// A parallelogram of columns x rows cells of two triangles, facing edgeU x edgeV; uv runs over [0, 1]².
  void quad(uint material, const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV, int columns = 1,
            int rows = 1);
  /// A square in the plane through `center`, facing `normal`.
  void square(uint material, const glm::dvec3& center, const glm::dvec3& normal, double side, int cells = 1);
  /// A regular polygon of `segments` corners on the circle: its area is segments/2 sin(2π/segments) radius².
  void disc(uint material, const glm::dvec3& center, const glm::dvec3& normal, double radius, int segments);
  /// A closed box, axis-parallel, each face of cells x cells quads.
  void box(uint material, const glm::dvec3& low, const glm::dvec3& high, Facing facing, int cells = 1);
  /// `rings` x `segments`, with poles on the y axis; all vertices lie on the sphere.
  void uvSphere(uint material, const glm::dvec3& center, double radius, int rings, int segments, Facing facing,
                Shading shading);
  /// 20·4^subdivisions triangles; all vertices lie on the sphere.
  void icosphere(uint material, const glm::dvec3& center, double radius, int subdivisions, Facing facing,
                 Shading shading);

  void pointLight(const glm::dvec3& position, const vec3& intensity);  // W/sr
  /// KHR_lights_punctual's spot light, angles in radians from the axis, 0 <= inner < outer <= π/2.
  void spotLight(const glm::dvec3& position, const glm::dvec3& direction, const vec3& intensity, double inner,
                 double outer);
  void directionalLight(const glm::dvec3& direction, const vec3& irradiance);  // W/m² on a plane across it
  void environment(const vec3& radiance);                                      // W/(m² sr)
  void environment(const EnvironmentMap& map) { environment_ = map; }

  /// A pinhole camera; yfov in radians. `up` need not be orthogonal to the view, but not parallel to it.
  void camera(const glm::dvec3& position, const glm::dvec3& target, double yfov, int width, int height,
              const glm::dvec3& up = glm::dvec3(0, 1, 0));

  /// Applied to all shapes, punctual lights and cameras by finish(): a rotation, a uniform scale and a
  /// translation. Radiances, intensities and irradiances stay as they were given.
  void transform(const glm::dmat4& worldFromBuilt) { worldFromBuilt_ = worldFromBuilt; }

  /// The scene with bounds, lights and their powers, in the render space that the loader would choose. Without
  /// triangles, throws std::logic_error. It may have no light or no camera.
  [[nodiscard]] Scene finish() const;

 private:
  uint vertex(const glm::dvec3& position, const glm::dvec3& normal, const vec2& uv);
  /// Adds a triangle that is counter-clockwise from outside.
  void sphereTriangle(uint material, uint a, uint b, uint c, Facing facing);
  void placeVertices(Scene& scene) const;
  void placeLights(Scene& scene) const;
  void placeCameras(Scene& scene) const;

  struct PunctualLight {
    Light light;
    glm::dvec3 position{0};
    glm::dvec3 direction{0, -1, 0};
  };

  std::vector<Material> materials_;
  std::vector<std::string> names_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::dvec3> normals_;  // 0: none
  std::vector<vec2> uvs_;
  std::vector<Triangle> triangles_;
  std::vector<PunctualLight> lights_;
  std::vector<Camera> cameras_;
  std::optional<EnvironmentMap> environment_;
  glm::dmat4 worldFromBuilt_{1.0};
};

/// Two unit vectors that with `normal` (unit length) make a right-handed frame.
void tangentFrame(const glm::dvec3& normal, glm::dvec3& tangent, glm::dvec3& bitangent);

}  // namespace importon::test
