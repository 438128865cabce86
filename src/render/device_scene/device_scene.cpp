#include "render/device_scene/device_scene.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <span>

#include "render/device_scene/albedo_table.h"
#include "render/device_scene/instances.h"
#include "render/device_scene/light_tree.h"
#include "render/device_scene/media.h"
#include "render/plan/pass_plan.h"
#include "scene/environment.h"

namespace importon {
namespace {

using gpu::TexelFormat;

/// Three texels per vertex: position and normal; both UV sets; tangent and colour.
std::vector<uvec4> packVertices(const Scene& scene) {
  std::vector<uvec4> texels(3 * scene.vertices.size());
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    const Vertex& v = scene.vertices[i];
    const vec4 uv(v.uv0, v.uv1);
    std::memcpy(&texels[3 * i], &scene.positions[i], sizeof(vec3));
    texels[3 * i].w = v.normal;
    std::memcpy(&texels[3 * i + 1], &uv, sizeof uv);
    texels[3 * i + 2] = uvec4(v.tangent, v.colorRG, v.colorBA, 0);
  }
  return texels;
}

/// Four texels per texture: see lib/texture.glsl.
std::vector<uvec4> packTextures(const Scene& scene) {
  std::vector<uvec4> texels(std::max<std::size_t>(4 * scene.textures.size(), 4));
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    const Texture& t = scene.textures[i];
    const float rows[] = {t.uvRow0.x, t.uvRow0.y, t.uvRow0.z, t.uvRow1.x, t.uvRow1.y, t.uvRow1.z, 0, 0};
    texels[4 * i] = uvec4(t.firstTexel, t.width, t.height, t.wrapS);
    texels[4 * i + 1] = uvec4(t.wrapT, t.isNearest, t.isSrgb, t.uvSet);
    std::memcpy(&texels[4 * i + 2], rows, sizeof rows);
    texels[4 * i + 3].z = t.isDeep;
  }
  return texels;
}

/// A light with what only the device asks for: centroid, normal and sidedness of triangles.
Light completeLight(const Scene& scene, Light light) {
  if (light.kind != kLightTriangle) return light;
  const Triangle& t = scene.triangles[light.triangle];
  const vec3 a = scene.positions[t.v0], b = scene.positions[t.v1], c = scene.positions[t.v2];
  light.position = (a + b + c) / 3.0f;
  light.direction = vec3(glm::normalize(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a))));
  light.isTwoSided = (scene.materials[t.material].flags & kMaterialDoubleSided) != 0;
  return light;
}

/// Four texels per light: see lib/light.glsl.
std::vector<uvec4> packLights(const Scene& scene) {
  std::vector<uvec4> texels;
  for (const Light& given : scene.lights) {
    const Light light = completeLight(scene, given);
    const auto texel = [](vec3 v, uint w) {
      return uvec4(std::bit_cast<uint>(v.x), std::bit_cast<uint>(v.y), std::bit_cast<uint>(v.z), w);
    };
    texels.push_back(texel(light.position, light.kind));
    texels.push_back(texel(light.direction, std::bit_cast<uint>(light.power)));
    texels.push_back(texel(light.emission, std::bit_cast<uint>(light.area)));
    texels.push_back(uvec4(light.triangle, light.isTwoSided, std::bit_cast<uint>(light.cosInner),
                           std::bit_cast<uint>(light.cosOuter)));
  }
  return texels;
}

std::vector<uvec4> packLightTree(const Scene& scene) {
  if (scene.lights.empty()) return {};
  std::vector<LightBounds> bounds;
  for (const Light& light : scene.lights) bounds.push_back(boundLight(scene, completeLight(scene, light)));
  return buildLightTree(bounds);
}

/// Radiance and the density of drawing each texel.
std::vector<uvec4> packEnvironment(const EnvironmentMap& map, const std::vector<float>& densities) {
  std::vector<uvec4> texels(map.texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const vec4 texel(map.texels[i], densities[i]);
    std::memcpy(&texels[i], &texel, sizeof texel);
  }
  return texels;
}

std::vector<uvec2> packDraw(const std::vector<DrawnEntry>& entries) {
  std::vector<uvec2> texels;
  for (const DrawnEntry& entry : entries) texels.emplace_back(entry.first, std::bit_cast<uint>(entry.end));
  return texels;
}

template <class T, class Allocator>
gpu::Buffer buffer(gpu::Context& context, const char* name, const std::vector<T, Allocator>& data,
                   TexelFormat format = TexelFormat::none) {
  const std::vector<T, Allocator> placeholder(1, T{});
  return gpu::makeBuffer<T>(context, name, data.empty() ? placeholder : data, format);
}

/// Appends the bytes of `data` as whole items of `to`; the index of the first.
template <class Word, class Items>
uint append(std::vector<Word>& to, const Items& data) {
  const std::span bytes = std::as_bytes(std::span(data));
  const std::size_t first = to.size();
  to.resize(first + bytes.size() / sizeof(Word));
  std::ranges::copy(bytes, std::as_writable_bytes(std::span(to)).begin() + first * sizeof(Word));
  return static_cast<uint>(first);
}

/// The small tables, which share two buffers.
void uploadTables(DeviceScene& d, gpu::Context& context, const Scene& scene, const Bvh& bvh) {
  std::vector<uvec4> tables = packInstances(scene.placed, bvh.meshRoots);
  std::vector<uint> lists;
  append(lists, albedoTable());
  TableStarts starts{};
  starts.materials = append(tables, withMedia(scene.materials));
  starts.textures = append(tables, packTextures(scene));
  starts.lights = append(tables, packLights(scene));
  starts.lightTree = append(tables, packLightTree(scene));
  starts.instanceOfPage = append(lists, instancesOfPages(scene.placed));
  starts.lightOfTriangle = append(lists, scene.lightOfTriangle);
  d.starts = gpu::makeBuffer(context, "starts of tables", std::span<const TableStarts>(&starts, 1));
  d.tables = buffer(context, "tables", tables, TexelFormat::uint4);
  d.lists = buffer(context, "lists", lists, TexelFormat::uint1);
}

/// Shares of the photons without a guide: by power, but a part of them evenly, so that a light beside a much stronger
/// one still gets photons where only it shines.
std::vector<double> emissionWeights(const Scene& scene) {
  constexpr double kEvenShare = 0.05;
  double sum = 0;
  for (const Light& light : scene.lights) sum += light.power;
  std::vector<double> weights;
  for (const Light& light : scene.lights)
    weights.push_back((1 - kEvenShare) * light.power + kEvenShare * sum / static_cast<double>(scene.lights.size()));
  return weights;
}

}  // namespace

std::vector<LightAlias> makeAliasTable(const std::vector<double>& weights) {
  const std::size_t n = weights.size();
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<LightAlias> table(n);
  std::vector<double> scaled(n);
  std::vector<std::size_t> small, large;
  for (std::size_t i = 0; i < n; ++i) {
    scaled[i] = weights[i] / sum * static_cast<double>(n);
    table[i] = {1.0f, static_cast<uint>(i), static_cast<float>(weights[i] / sum)};
    (scaled[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::size_t s = small.back(), l = large.back();
    small.pop_back();
    table[s].threshold = static_cast<float>(scaled[s]);
    table[s].other = static_cast<uint>(l);
    scaled[l] -= 1 - scaled[s];
    if (scaled[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  return table;
}

DeviceScene uploadScene(gpu::Context& context, const Scene& scene, const Bvh& bvh) {
  static_assert(sizeof(Material) == kMaterialTexels * 16 && sizeof(Triangle) == 16, "read as whole texels");
  DeviceScene d;
  d.area = surfaceArea(scene);
  d.bvh = buffer(context, "BVH", bvh.nodes, TexelFormat::uint4);
  d.vertices = buffer(context, "vertices", packVertices(scene), TexelFormat::uint4);
  d.triangles = buffer(context, "triangles", scene.triangles, TexelFormat::uint4);
  d.images = buffer(context, "texels", scene.texels, TexelFormat::uint1);
  d.lightAlias = buffer(context, "light alias table", makeAliasTable(emissionWeights(scene)));
  uploadTables(d, context, scene, bvh);
  const EnvironmentMap black{1, 1, {vec3(0.0f)}};
  const EnvironmentMap& environment = scene.environment ? *scene.environment : black;
  const EnvironmentDraw draw = drawByLight(environment);
  d.environment = buffer(context, "environment", packEnvironment(environment, draw.densities), TexelFormat::uint4);
  d.environmentDraw = buffer(context, "environment draw", packDraw(draw.entries), TexelFormat::uint2);
  return d;
}

}  // namespace importon
