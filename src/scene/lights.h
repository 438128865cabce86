/// The power of lights (W, mean of the channels), and the lights that a scene's own data give: emissive
/// triangles and the environment.
#pragma once
#include "scene/scene.h"

namespace importon {

/// A sphere around all triangles, render space.
struct BoundingSphere {
  vec3 centre{0.0f};
  float radius = 0;  // m
};
[[nodiscard]] BoundingSphere boundingSphere(const Scene& scene);

/// W that a Lambertian emitter of `area` m² and radiance L W/(m² sr) gives off: pi A L, from both sides twice
/// that.
[[nodiscard]] float trianglePower(float area, const vec3& radiance, bool isDoubleSided);

/// W of a point light of `intensity` W/sr: 4 pi I.
[[nodiscard]] float pointPower(const vec3& intensity);

/// W of a spot light whose intensity falls as KHR_lights_punctual says, I(c) = I clamp((c - co) / (ci - co))²
/// for the cosine c to its axis: the integral over the cone is 2 pi I ((1 - ci) + (ci - co) / 3).
[[nodiscard]] float spotPower(const vec3& intensity, float cosInner, float cosOuter);

/// W of a light that sends shares of its greatest `intensity`, W/sr, whose integral over all directions is
/// `shareIntegral`, sr.
[[nodiscard]] float profilePower(const vec3& intensity, double shareIntegral);

/// W of parallel light of `irradiance` W/m² through the disc of the scene's bounding sphere: E pi r².
[[nodiscard]] float directionalPower(const vec3& irradiance, float sceneRadius);

/// W of an environment of mean `radiance` W/(m² sr) through the scene's bounding sphere: from each of the
/// 4 pi sr of directions it meets a disc of pi r², so 4 pi · pi r² · L.
[[nodiscard]] float environmentPower(const vec3& radiance, float sceneRadius);

/// Appends a light for each triangle of an emissive material whose mean radiance over the triangle isn't 0, and
/// fills lightOfTriangle if there is one. The scene's geometry, materials and textures are complete.
void addEmissiveTriangles(Scene& scene);

/// Appends the environment's light if the scene has a radiance for it.
void addEnvironmentLight(Scene& scene);

}  // namespace importon
