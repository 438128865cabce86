#include "scene/container/gltf_schema_rules.h"

#include "scene/materials/material_table.h"

namespace importon {
namespace {

using enum SchemaKind;

constexpr double kMaxInteger = 2147483647.0;

/// Collects rules below one path.
class Rules {
 public:
  Rules(std::vector<SchemaRule>& rules, std::string base) : rules_(rules), base_(std::move(base)) {}

  Rules& optional(const std::string& key, SchemaKind kind) { return add({.path = key, .kind = kind}); }
  Rules& required(const std::string& key, SchemaKind kind) {
    return add({.path = key, .kind = kind, .isRequired = true});
  }
  Rules& choice(const std::string& key, std::vector<std::string> choices, bool isRequired = true) {
    return add({.path = key, .kind = string, .isRequired = isRequired, .choices = std::move(choices)});
  }
  Rules& count(const std::string& key, double least = 0, bool isRequired = false, double most = kMaxInteger) {
    return add({.path = key, .kind = integer, .isRequired = isRequired, .least = least, .most = most});
  }
  Rules& range(const std::string& key, double least, double most = kNoLimit) {
    return add({.path = key, .kind = number, .least = least, .most = most, .repair = SchemaRepair::clamp});
  }
  Rules& vector(const std::string& key, std::size_t length, double least = -kNoLimit, double most = kNoLimit) {
    return add(
        {.path = key, .kind = numbers, .least = least, .most = most, .length = length, .repair = SchemaRepair::clamp});
  }
  Rules& reference(const std::string& key, const std::string& target, SchemaKind kind = index,
                   bool isRequired = false) {
    return add({.path = key, .kind = kind, .isRequired = isRequired, .target = target});
  }
  /// What is done where the rule that was added last is broken.
  Rules& orElse(SchemaRepair repair) {
    rules_.back().repair = repair;
    return *this;
  }
  /// A textureInfo with KHR_texture_transform.
  Rules& texture(const std::string& key) {
    const std::string transform = key + "/extensions/KHR_texture_transform";
    optional(key, object).reference(key + "/index", "textures", index, true).count(key + "/texCoord");
    optional(transform, object).vector(transform + "/offset", 2).optional(transform + "/rotation", number);
    return vector(transform + "/scale", 2).count(transform + "/texCoord");
  }

 private:
  Rules& add(SchemaRule rule) {
    if (!base_.empty()) rule.path = base_ + "/" + rule.path;
    rules_.push_back(std::move(rule));
    return *this;
  }
  std::vector<SchemaRule>& rules_;
  std::string base_;
};

void addRoot(std::vector<SchemaRule>& rules) {
  Rules root(rules, "");
  root.required("asset", object).required("asset/version", string);
  root.optional("extensionsUsed", strings).optional("extensionsRequired", strings).optional("extensions", object);
  root.optional("extensions/KHR_lights_punctual", object);
  root.required("extensions/KHR_lights_punctual/lights", objects);
  for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers", "images", "samplers",
                          "textures", "materials", "cameras", "skins"}) {
    root.optional(key, objects);
  }
  root.reference("scene", "scenes").orElse(SchemaRepair::drop).reference("scenes/*/nodes", "nodes", indices);
}

void addNodes(std::vector<SchemaRule>& rules) {
  Rules node(rules, "nodes/*");
  node.reference("children", "nodes", indices).reference("mesh", "meshes").reference("camera", "cameras");
  node.reference("skin", "skins").vector("matrix", 16).vector("translation", 3).vector("rotation", 4);
  node.vector("scale", 3).vector("weights", 0);
  node.optional("extensions", object).optional("extensions/KHR_lights_punctual", object);
  node.reference("extensions/KHR_lights_punctual/light", "extensions/KHR_lights_punctual/lights", index, true);
  Rules environment(rules, "scenes/*/extras/environment");
  environment.optional("type", string).vector("radiance", 3, 0, kBrightestFactor);
  const std::string imageBased = "extensions/EXT_lights_image_based", draft = "extensions/KHR_lights_environment";
  Rules(rules, "scenes/*").reference(imageBased + "/light", imageBased + "/lights", index, true);
  for (const char* use : {"/light", "/environment"})
    Rules(rules, "scenes/*").reference(draft + use, draft + "/lights", index);
  for (const std::string& extension : {imageBased, draft}) {
    Rules(rules, "scenes/*").optional(extension, object);
    Rules(rules, "").optional(extension, object).required(extension + "/lights", objects);
    Rules imageLight(rules, extension + "/lights/*");
    imageLight.range("intensity", 0, kBrightestFactor)
        .vector("rotation", 4)
        .vector("irradianceCoefficients/*", 3, -kBrightestFactor, kBrightestFactor);
    imageLight.reference("specularImages/*", "images", indices);
  }
  Rules skin(rules, "skins/*");
  skin.reference("joints", "nodes", indices, true).reference("skeleton", "nodes");
  skin.reference("inverseBindMatrices", "accessors");
}

void addNodeExtensions(std::vector<SchemaRule>& rules) {
  Rules node(rules, "nodes/*/extensions");
  node.optional("KHR_node_visibility", object).optional("KHR_node_visibility/visible", boolean);
  node.optional("EXT_mesh_gpu_instancing", object);
  node.reference("EXT_mesh_gpu_instancing/attributes", "accessors", indexMap);
}

void addProfileLights(std::vector<SchemaRule>& rules) {
  const std::string profiles = "extensions/EXT_lights_ies";
  Rules(rules, "").optional(profiles, object).required(profiles + "/lights", objects);
  Rules profile(rules, profiles + "/lights/*");
  profile.optional("uri", string).reference("bufferView", "bufferViews");
  Rules light(rules, "nodes/*/" + profiles);
  Rules(rules, "nodes/*").optional(profiles, object);
  light.reference("light", profiles + "/lights", index, true).range("multiplier", 0, kBrightestFactor);
  light.vector("color", 3, 0, 1);
}

void addVariants(std::vector<SchemaRule>& rules) {
  const std::string variants = "extensions/KHR_materials_variants";
  Rules(rules, "").optional(variants, object).required(variants + "/variants", objects);
  Rules primitive(rules, "meshes/*/primitives/*");
  primitive.optional(variants, object).required(variants + "/mappings", objects);
  Rules mapping(rules, "meshes/*/primitives/*/" + variants + "/mappings/*");
  mapping.reference("material", "materials", index, true);
  mapping.reference("variants", variants + "/variants", indices, true);
}

void addMeshes(std::vector<SchemaRule>& rules) {
  Rules mesh(rules, "meshes/*");
  mesh.required("primitives", objects).vector("weights", 0);
  Rules primitive(rules, "meshes/*/primitives/*");
  primitive.reference("attributes", "accessors", indexMap, true).orElse(SchemaRepair::empty);
  primitive.reference("indices", "accessors");
  primitive.reference("material", "materials").count("mode", 0, false, 6).optional("targets", objects);
  primitive.reference("targets/*", "accessors", indexMap);
  const std::string draco = "extensions/KHR_draco_mesh_compression";
  primitive.optional(draco, object).reference(draco + "/bufferView", "bufferViews", index, true);
  primitive.required(draco + "/attributes", object);
}

void addData(std::vector<SchemaRule>& rules) {
  Rules accessor(rules, "accessors/*");
  accessor.reference("bufferView", "bufferViews").count("byteOffset").count("componentType", 0, true);
  accessor.count("count", 1, true).orElse(SchemaRepair::keep).count("count");
  accessor.choice("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
  accessor.optional("normalized", boolean);
  accessor.optional("sparse", object).count("sparse/count", 1, true);
  accessor.required("sparse/indices", object).required("sparse/values", object);
  accessor.reference("sparse/indices/bufferView", "bufferViews", index, true).count("sparse/indices/byteOffset");
  accessor.count("sparse/indices/componentType", 0, true);
  accessor.reference("sparse/values/bufferView", "bufferViews", index, true).count("sparse/values/byteOffset");
  Rules view(rules, "bufferViews/*");
  view.reference("buffer", "buffers", index, true).count("byteOffset");
  view.count("byteLength", 1, true).orElse(SchemaRepair::keep).count("byteLength");
  rules.back().repair = SchemaRepair::keep;
  view.count("byteStride", 4, false, 252).orElse(SchemaRepair::keep).count("byteStride");
  Rules buffer(rules, "buffers/*");
  buffer.count("byteLength", 1, true).orElse(SchemaRepair::keep).count("byteLength").optional("uri", string);
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    Rules meshopt(rules, std::string("bufferViews/*/extensions/") + name);
    meshopt.reference("buffer", "buffers", index, true).count("byteOffset").count("byteLength", 1, true);
    meshopt.count("byteStride", 1, true, 256).count("count", 1, true);
    meshopt.choice("mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}).optional("filter", string);
  }
}

void addTextures(std::vector<SchemaRule>& rules) {
  Rules image(rules, "images/*");
  image.optional("uri", string).reference("bufferView", "bufferViews").optional("mimeType", string);
  Rules sampler(rules, "samplers/*");
  sampler.count("magFilter").count("minFilter").count("wrapS").count("wrapT");
  Rules texture(rules, "textures/*");
  texture.reference("sampler", "samplers").reference("source", "images");
  for (const char* name : {"EXT_texture_avif", "EXT_texture_webp", "KHR_texture_basisu"}) {
    texture.reference(std::string("extensions/") + name + "/source", "images");
  }
}

void addSpecularGlossiness(std::vector<SchemaRule>& rules) {
  Rules(rules, "materials/*/extensions").optional("KHR_materials_pbrSpecularGlossiness", object);
  Rules material(rules, "materials/*/extensions/KHR_materials_pbrSpecularGlossiness");
  material.vector("diffuseFactor", 4, 0, 1).vector("specularFactor", 3, 0, 1).range("glossinessFactor", 0, 1);
  material.texture("diffuseTexture").texture("specularGlossinessTexture");
}

void addMaterials(std::vector<SchemaRule>& rules) {
  Rules material(rules, "materials/*");
  material.optional("pbrMetallicRoughness", object).optional("extensions", object);
  material.choice("alphaMode", {"OPAQUE", "MASK", "BLEND"}, false)
      .orElse(SchemaRepair::drop)
      .optional("doubleSided", boolean);
  Rules extension(rules, "materials/*/extensions");
  for (const char* name : {"emissive_strength", "transmission", "ior", "volume", "specular", "clearcoat", "unlit",
                           "diffuse_transmission", "sheen", "anisotropy", "iridescence", "dispersion"}) {
    extension.optional(std::string("KHR_materials_") + name, object);
  }
  extension.range("KHR_materials_emissive_strength/emissiveStrength", 0, kBrightestFactor)
      .range("KHR_materials_ior/ior", 0);
  Rules volume(rules, "materials/*/extensions/KHR_materials_volume");
  volume.range("attenuationDistance", 0).vector("attenuationColor", 3, 0, 1);
  addSpecularGlossiness(rules);
  for (const MaterialRow& row : materialRows()) {
    const std::string key = (row.place.empty() ? "" : std::string(row.place) + "/") + std::string(row.key);
    if (std::holds_alternative<MaterialTexture>(row.field)) material.texture(key);
    if (std::holds_alternative<float Material::*>(row.field)) material.range(key, row.least, row.most);
    if (std::holds_alternative<vec3 Material::*>(row.field)) material.vector(key, 3, row.least, row.most);
    if (std::holds_alternative<vec4 Material::*>(row.field)) material.vector(key, 4, row.least, row.most);
  }
}

void addCamerasAndLights(std::vector<SchemaRule>& rules) {
  Rules camera(rules, "cameras/*");
  camera.choice("type", {"perspective", "orthographic"})
      .optional("perspective", object)
      .optional("orthographic", object);
  camera.required("perspective/yfov", number).required("perspective/znear", number).range("perspective/aspectRatio", 0);
  for (const char* key : {"xmag", "ymag", "zfar", "znear"}) camera.required(std::string("orthographic/") + key, number);
  Rules light(rules, "extensions/KHR_lights_punctual/lights/*");
  light.choice("type", {"point", "spot", "directional"})
      .orElse(SchemaRepair::drop)
      .vector("color", 3, 0, kBrightestFactor)
      .range("intensity", 0, kBrightestFactor)
      .range("range", 0);
  light.optional("spot", object).range("spot/innerConeAngle", 0).range("spot/outerConeAngle", 0);
}

std::vector<SchemaRule> makeAnimationRules() {
  std::vector<SchemaRule> rules;
  Rules(rules, "").optional("animations", objects);
  Rules animation(rules, "animations/*");
  animation.required("channels", objects).required("samplers", objects);
  Rules channel(rules, "animations/*/channels/*");
  channel.count("sampler", 0, true).required("target", object).required("target/path", string);
  channel.reference("target/node", "nodes");
  const std::string pointer = "target/extensions/KHR_animation_pointer";
  channel.optional(pointer, object).required(pointer + "/pointer", string);
  Rules sampler(rules, "animations/*/samplers/*");
  sampler.reference("input", "accessors", index, true).reference("output", "accessors", index, true);
  sampler.choice("interpolation", {"LINEAR", "STEP", "CUBICSPLINE"}, false).orElse(SchemaRepair::drop);
  return rules;
}

std::vector<SchemaRule> makeRules() {
  std::vector<SchemaRule> rules;
  addRoot(rules);
  addNodes(rules);
  addNodeExtensions(rules);
  addProfileLights(rules);
  addMeshes(rules);
  addVariants(rules);
  addData(rules);
  addTextures(rules);
  addMaterials(rules);
  addCamerasAndLights(rules);
  return rules;
}

}  // namespace

const std::vector<SchemaRule>& schemaRules() {
  static const std::vector<SchemaRule> kRules = makeRules();
  return kRules;
}

const std::vector<SchemaRule>& animationRules() {
  static const std::vector<SchemaRule> kRules = makeAnimationRules();
  return kRules;
}

}  // namespace importon
