#include "scene/materials/gltf_material.h"
#include "support/scene_builder.h"

namespace importon::test {
namespace {

/// The glTF default material, but not metallic.
Material plain(const vec3& baseColor) {
  Material material = defaultMaterial();
  material.baseColor = vec4(baseColor, 1.0f);
  material.metallic = 0.0f;
  return material;
}

}  // namespace

Material diffuse(const vec3& albedo) {
  Material material = plain(albedo);
  material.specular = 0.0f;
  return material;
}

Material emitter(const vec3& radiance, bool isDoubleSided, const vec3& albedo) {
  Material material = diffuse(albedo);
  material.emission = radiance;
  material.flags = kMaterialEmissive | (isDoubleSided ? kMaterialDoubleSided : 0u);
  return material;
}

Material mirror(const vec3& reflectance) { return metal(reflectance, 0.0f); }

Material metal(const vec3& reflectance, float roughness) {
  Material material = plain(reflectance);
  material.metallic = 1.0f;
  material.roughness = roughness;
  return material;
}

Material glass(float ior, const vec3& absorption) {
  Material material = thinGlass(ior);
  material.absorption = absorption;
  material.flags = kMaterialSolid;
  return material;
}

Material thinGlass(float ior) {
  Material material = plain(vec3(1.0f));
  material.transmission = 1.0f;
  material.roughness = 0.0f;
  material.ior = ior;
  return material;
}

}  // namespace importon::test
