// The surface at a hit: position with its error, normals, and the material's values there.
// The kernel defines `uvec4 triangleTexel(uint)`, `uvec4 vertexTexel(uint)`, `uvec4 materialTexel(uint)` and
// what lib/texture.glsl and lib/placement.glsl ask for before including this file.
#ifndef IMPORTON_LIB_SURFACE_GLSL
#define IMPORTON_LIB_SURFACE_GLSL
#include "lib/features.glsl"
#include "lib/offset.glsl"
#include "lib/packing.glsl"
#include "lib/placement.glsl"
#include "lib/sampling.glsl"
#include "lib/texture.glsl"
#include "shared/elementary.h"

struct Surface {
  vec3 position;
  vec3 error;            // bound on the position's rounding error, m
  vec3 geometricNormal;  // on the side that the ray came from
  vec3 shadingNormal;    // likewise, and never facing away from the ray
  vec3 mapNormal;        // of photons and importons here: the side they are on, or one side for both where light passes
  mat3 frame;            // local frame of the BSDF: z is the shading normal
  bool isFront;
  bool canEmit;          // the side emits
  uint material;
  uint flags;
  vec3 baseColor;
  float metallic;
  float alpha;           // GGX roughness: glTF roughness squared
  float transmission;
  float ior;
  vec3 specularColor;    // KHR_materials_specular: of the dielectric interface at normal incidence
  float specular;        // and its strength
  float coat;            // KHR_materials_clearcoat
  float coatAlpha;
  vec3 coatNormal;       // as shadingNormal
  vec3 lift;             // m, from `position` to the surface that smooth normals stand for
  float coatCosOut;      // cosine between the ray, backwards, and coatNormal
  vec3 diffuseTransmissionColor;  // KHR_materials_diffuse_transmission
  float diffuseTransmission;
  vec3 sheenColor;       // KHR_materials_sheen
  float sheenAlpha;
  vec2 alphas;           // KHR_materials_anisotropy: GGX roughness along the tangent, and across
  vec3 tangent;          // of that, of any length
  vec3 backwards;        // the ray's direction, turned round
  float iridescence;     // KHR_materials_iridescence
  float filmIor;
  float filmThickness;   // nm
  float dispersion;      // KHR_materials_dispersion
  vec3 emission;         // W/(m² sr)
  vec3 absorption;       // 1/m, of the solid behind the surface
  vec3 sheetDepth;       // optical thickness of a sheet, across it
};

/// Unit normal of the front (counter-clockwise) side.
vec3 triangleNormal(vec3 p0, vec3 p1, vec3 p2) {
  const vec3 n = cross(p1 - p0, p2 - p0);
  // Scaled first: the square of a small triangle's area may underflow.
  const float size = max(abs(n.x), max(abs(n.y), abs(n.z)));
  return normalize(n / size);
}

vec3 vertexPosition(uint vertex) { return uintBitsToFloat(vertexTexel(3u * vertex).xyz); }

/// Texture coordinates at barycentric weights (u, v).
void interpolateUv(uvec3 vertices, vec3 weights, out vec2 uv0, out vec2 uv1) {
  const vec4 a = uintBitsToFloat(vertexTexel(3u * vertices.x + 1u));
  const vec4 b = uintBitsToFloat(vertexTexel(3u * vertices.y + 1u));
  const vec4 c = uintBitsToFloat(vertexTexel(3u * vertices.z + 1u));
  const vec4 uv = weights.x * a + weights.y * b + weights.z * c;
  uv0 = uv.xy;
  uv1 = uv.zw;
}

/// Tangent frame or vertex colour: the third texel.
void interpolateExtras(Placement place, uvec3 vertices, vec3 weights, out vec4 tangent, out vec4 color) {
  tangent = vec4(0.0);
  color = vec4(0.0);
  for (uint i = 0u; i < 3u; ++i) {
    const uvec4 texel = vertexTexel(3u * vertices[i] + 2u);
    if ((kHasNormalMaps || kHasAnisotropy) && texel.x != kNone) {
      const vec4 t = placedTangent(place, unpackTangent(texel.x));
      tangent.xyz += weights[i] * t.xyz;
      tangent.w = t.w;
    }
    color += weights[i] * vec4(unpackHalf2x16(texel.y), unpackHalf2x16(texel.z));
  }
}

/// A material's textures: what each tells is multiplied with the material's own value, or is a normal.
struct SurfaceTextures {
  vec3 baseColor, emission, specularColor;
  float roughness, metallic, transmission, specular, coat, coatRoughness;
  vec3 normal, coatNormal;  // in tangent space; 0: none
  float diffuseTransmission, sheenRoughness, iridescence, filmThickness, thickness;
  vec3 diffuseTransmissionColor, sheenColor;
  vec3 anisotropy;  // direction in tangent space, and strength
};

SurfaceTextures noTextures() {
  SurfaceTextures t;
  t.baseColor = t.emission = t.specularColor = t.diffuseTransmissionColor = t.sheenColor = vec3(1.0);
  t.roughness = t.metallic = t.transmission = t.specular = t.coat = t.coatRoughness = 1.0;
  t.diffuseTransmission = t.sheenRoughness = t.iridescence = t.filmThickness = t.thickness = 1.0;
  t.normal = t.coatNormal = vec3(0.0);
  t.anisotropy = vec3(1.0, 0.0, 1.0);
  return t;
}

const bool kHasLayers = kHasDiffuseTransmission || kHasSheen || kHasAnisotropy || kHasIridescence || kHasDispersion ||
                        kHasThicknessTextures || kHasSheets;
const bool kHasLayerTextures = kHasTextures && kHasLayers;

/// Of texture k, counted from 0 in those texels.
void takeLayerTexture(inout SurfaceTextures t, int k, vec4 v) {
  if (k == 0) t.diffuseTransmission = v.a;
  if (k == 1) t.diffuseTransmissionColor = v.rgb;
  if (k == 2) t.sheenColor = v.rgb;
  if (k == 3) t.sheenRoughness = v.a;
  if (k == 4) t.anisotropy = vec3(v.rg * 2.0 - 1.0, v.b);
  if (k == 5) t.iridescence = v.r;
  if (k == 6) t.filmThickness = v.g;
  if (k == 7) t.thickness = v.g;
}

const uint kFirstLayer = 10u;

/// Samples those that the material has, one after the other in one place: a kernel then holds the sampling once, and
/// a hit costs as many samples as the material has textures, where lavapipe would run both sides of every branch.
SurfaceTextures sampleTextures(uint base, uint baseColorTexture, vec2 uv0, vec2 uv1) {
  const uvec4 m6 = materialTexel(base + 6u), m7 = materialTexel(base + 7u);
  const uint coatNormalTexture = kHasNormalMaps && kHasClearcoat ? materialTexel(base + 8u).x : kNone;
  const uint normalTexture = kHasNormalMaps ? m6.y : kNone;
  uint left = uint(baseColorTexture != kNone) | uint(m6.x != kNone) << 1 | uint(normalTexture != kNone) << 2 |
              uint(m6.z != kNone) << 3 | uint(m6.w != kNone) << 4 | uint(m7.x != kNone) << 5 |
              uint(m7.y != kNone) << 6 | uint(coatNormalTexture != kNone) << 9;
  if (kHasClearcoat) left |= uint(m7.z != kNone) << 7 | uint(m7.w != kNone) << 8;
  uvec4 layers[2] = uvec4[2](uvec4(kNone), uvec4(kNone));
  if (kHasLayerTextures) {
    layers[0] = materialTexel(base + 13u);
    layers[1] = materialTexel(base + 14u);
    for (uint k = 0u; k < 8u; ++k) left |= uint(layers[k / 4u][k % 4u] != kNone) << (kFirstLayer + k);
  }
  SurfaceTextures t = noTextures();
  while (left != 0u) {
    const int k = findLSB(left);
    left &= left - 1u;
    const int layer = k - int(kFirstLayer);
    const uint texture = kHasLayerTextures && layer >= 0 ? layers[layer / 4][layer % 4]
                         : k == 0                        ? baseColorTexture
                         : k < 5                         ? m6[k - 1]
                         : k < 9                         ? m7[k - 5]
                                                         : coatNormalTexture;
    const vec4 v = sampleTexture(texture, uv0, uv1);
    if (k == 0) t.baseColor = v.rgb;
    if (k == 1) t.roughness = v.g;
    if (k == 1) t.metallic = v.b;
    if (k == 2) t.normal = v.xyz * 2.0 - 1.0;
    if (k == 3) t.emission = v.rgb;
    if (k == 4) t.transmission = v.r;
    if (k == 5) t.specular = v.a;
    if (k == 6) t.specularColor = v.rgb;
    if (k == 7) t.coat = v.r;
    if (k == 8) t.coatRoughness = v.g;
    if (k == 9) t.coatNormal = v.xyz * 2.0 - 1.0;
    if (kHasLayerTextures && layer >= 0) takeLayerTexture(t, layer, v);
  }
  return t;
}

/// Turns the shading normal back to the ray's side where it faces away, so that no light leaks through.
vec3 keepOnRaySide(vec3 shadingNormal, vec3 geometricNormal, vec3 direction) {
  const float away = dot(shadingNormal, direction);
  if (away < 0.0) return shadingNormal;
  // Push towards the geometric normal until the ray grazes it.
  const float facing = -dot(geometricNormal, direction);
  const float t = (away + 1e-3) / max(away + 1e-3 + facing, 1e-20);
  return normalize(mix(shadingNormal, geometricNormal, clamp(t, 0.0, 1.0)));
}

/// The same for a surface that reflects: turns the normal towards the geometric one as far as it takes for the mirror
/// direction to leave the surface, too; where it does not, a mirror would be black. In the plane of both normals let
/// the ray come at an angle a to the geometric normal: the mirror direction of a normal at angle n is at 2 n - a, so
/// the normal sought halves the angle between the ray and the direction just above the horizon.
vec3 keepMirrorOutside(vec3 shadingNormal, vec3 geometricNormal, vec3 direction) {
  const float cosGeometric = -dot(direction, geometricNormal), between = dot(shadingNormal, geometricNormal);
  const float least = min(0.9 * cosGeometric, 0.01);  // cosine of the mirror direction
  const float cosShading = -dot(direction, shadingNormal);
  if (cosShading > 0.0 && 2.0 * cosShading * between - cosGeometric >= least) return shadingNormal;
  const vec3 across = shadingNormal - between * geometricNormal;
  if (dot(across, across) < 1e-12) return geometricNormal;
  const vec3 axis = normalize(across);
  const vec2 ray = vec2(-dot(direction, axis), cosGeometric);
  const float size = length(ray), cosLeast = least / size;
  const vec2 halfway = normalize(ray / size + vec2(sqrt(1.0 - cosLeast * cosLeast), cosLeast));
  return normalize(halfway.x * axis + halfway.y * geometricNormal);
}

/// From a point of a triangle to the surface that its smooth normals stand for: where shadow rays start towards lights
/// near the horizon, so that facets cast no shadows on each other there. 0 on surfaces curved to the other side.
/// [Hanika 2021, Hacking the Shadow Terminator]
vec3 liftToSmooth(vec3 point, vec3 vertex, vec3 normal) { return max(-dot(point - vertex, normal), 0.0) * normal; }

/// `normal` turned as a normal map says: `m` in tangent space, 0 without a map.
vec3 mappedNormal(vec3 m, float scale, vec3 normal, vec4 tangent) {
  if (m == vec3(0.0) || dot(tangent.xyz, tangent.xyz) < 1e-12) return normal;
  m.xy *= scale;
  const vec3 t = normalize(tangent.xyz - normal * dot(normal, tangent.xyz));
  return normalize(m.x * t + m.y * tangent.w * cross(normal, t) + m.z * normal);
}

/// Direction of the greatest roughness: `direction` in tangent space, turned by the material's angle.
vec3 anisotropicTangent(vec2 direction, float rotation, vec3 normal, vec4 tangent) {
  const vec3 t = tangent.xyz - normal * dot(normal, tangent.xyz);
  const vec2 turn = portableCosSin(rotation);
  const vec2 d = vec2(direction.x * turn.x - direction.y * turn.y,
                      direction.x * turn.y + direction.y * turn.x);
  return d.x * t + d.y * tangent.w * cross(normal, t);
}

/// The material's extensions at the surface: their factors, and their textures.
void loadLayers(inout Surface s, uint base, SurfaceTextures t, vec4 tangent, vec3 normal) {
  const vec4 m11 = uintBitsToFloat(materialTexel(base + 11u)), m12 = uintBitsToFloat(materialTexel(base + 12u));
  s.diffuseTransmission = 0.0;
  if (kHasDiffuseTransmission) {
    const vec4 m9 = uintBitsToFloat(materialTexel(base + 9u));
    s.diffuseTransmission = m9.a * t.diffuseTransmission;
    s.diffuseTransmissionColor = m9.rgb * t.diffuseTransmissionColor;
    if (m9.a > 0.0 && !s.isFront) s.mapNormal = -s.geometricNormal;
  }
  if (kHasSheen) {
    const vec4 m10 = uintBitsToFloat(materialTexel(base + 10u));
    const float roughness = m10.a * t.sheenRoughness;
    s.sheenColor = m10.rgb * t.sheenColor;
    s.sheenAlpha = roughness * roughness;
  }
  if (kHasAnisotropy) {
    const float strength = m11.x * t.anisotropy.z;
    s.alphas = vec2(mix(s.alpha, 1.0, strength * strength), s.alpha);
    s.tangent = anisotropicTangent(t.anisotropy.xy, m11.y, normal, tangent);
  }
  if (kHasIridescence) {
    s.iridescence = m11.z * t.iridescence;
    s.filmIor = m11.w;
    s.filmThickness = mix(m12.x, m12.y, t.filmThickness);
  }
  if (kHasDispersion) s.dispersion = m12.z;
  if (kHasThicknessTextures && t.thickness <= 0.0) s.flags &= ~kMaterialSolid;
  if (kHasSheets && (s.flags & kMaterialSolid) == 0u) s.sheetDepth = s.absorption * (m12.w * t.thickness);
}

/// The surface that a ray of `direction` (unit) met at barycentric weights (u, v) of the triangle of that number.
Surface loadSurface(uint triangle, vec2 uvWeights, vec3 direction) {
  uint stored;
  const Placement place = findPlacement(triangle, stored);
  const uvec4 indices = triangleTexel(stored);
  const uvec4 t0 = vertexTexel(3u * indices.x), t1 = vertexTexel(3u * indices.y), t2 = vertexTexel(3u * indices.z);
  const vec3 p0 = placedVertex(place, uintBitsToFloat(t0.xyz)), p1 = placedVertex(place, uintBitsToFloat(t1.xyz)),
             p2 = placedVertex(place, uintBitsToFloat(t2.xyz));
  const vec3 weights = vec3(1.0 - uvWeights.x - uvWeights.y, uvWeights);
  Surface s;
  const HitPosition hit = hitPosition(p0, p1, p2, uvWeights.x, uvWeights.y);
  s.position = hit.position;
  s.error = hit.error;
  vec3 frontNormal = triangleNormal(p0, p1, p2);
  if (kHasInstances && place.isMirrored) frontNormal = -frontNormal;
  s.isFront = dot(frontNormal, direction) < 0.0;
  s.geometricNormal = s.isFront ? frontNormal : -frontNormal;
  vec3 normal = frontNormal;
  s.lift = vec3(0.0);
  if (t0.w != kNone && t1.w != kNone && t2.w != kNone) {
    const vec3 n0 = placedNormal(place, unpackNormal(t0.w)), n1 = placedNormal(place, unpackNormal(t1.w)),
               n2 = placedNormal(place, unpackNormal(t2.w));
    const vec3 n = weights.x * n0 + weights.y * n1 + weights.z * n2;
    if (dot(n, n) > 1e-12) normal = normalize(n);
    const float side = s.isFront ? 1.0 : -1.0;
    s.lift = weights.x * liftToSmooth(s.position, p0, side * n0) + weights.y * liftToSmooth(s.position, p1, side * n1) +
             weights.z * liftToSmooth(s.position, p2, side * n2);
  }

  s.material = indices.w;
  const uint base = kMaterialTexels * indices.w;
  const vec4 m0 = uintBitsToFloat(materialTexel(base)), m1 = uintBitsToFloat(materialTexel(base + 1u));
  const vec4 m2 = uintBitsToFloat(materialTexel(base + 2u)), m3 = uintBitsToFloat(materialTexel(base + 3u));
  const vec4 m4 = uintBitsToFloat(materialTexel(base + 4u));
  const uvec4 m5 = materialTexel(base + 5u);
  s.flags = m5.z;
  s.baseColor = m0.rgb;
  s.emission = m1.rgb;
  s.metallic = m1.a;
  float roughness = m2.a;
  s.absorption = m3.rgb;
  s.transmission = m3.a;
  s.ior = m4.x;
  float specular = m4.y;
  vec3 specularColor = m2.rgb;
  s.coat = uintBitsToFloat(m5.x);
  float coatRoughness = uintBitsToFloat(m5.y);
  vec3 coatNormal = normal;
  SurfaceTextures t = noTextures();
  vec4 tangent = vec4(0.0);
  if (kHasTextures || kHasVertexColors || kHasAnisotropy) {
    vec2 uv0, uv1;
    interpolateUv(indices.xyz, weights, uv0, uv1);
    vec4 color = vec4(1.0);
    if (kHasNormalMaps || kHasVertexColors || kHasAnisotropy)
      interpolateExtras(place, indices.xyz, weights, tangent, color);
    if (kHasVertexColors) s.baseColor *= color.rgb;
    if (kHasTextures) {
      t = sampleTextures(base, m5.w, uv0, uv1);
      s.baseColor *= t.baseColor;
      roughness *= t.roughness;
      s.metallic *= t.metallic;
      s.emission *= t.emission;
      s.transmission *= t.transmission;
      specular *= t.specular;
      specularColor *= t.specularColor;
      s.coat *= t.coat;
      coatRoughness *= t.coatRoughness;
      if (kHasNormalMaps && kHasClearcoat)
        coatNormal = mappedNormal(t.coatNormal, uintBitsToFloat(materialTexel(base + 8u).y), normal, tangent);
      if (kHasNormalMaps) normal = mappedNormal(t.normal, m4.z, normal, tangent);
    }
  }
  s.alpha = roughness * roughness;
  s.coatAlpha = coatRoughness * coatRoughness;
  const vec3 facing = s.isFront ? normal : -normal;
  const bool isReflector = kHasReflection && (s.metallic > 0.0 || specular > 0.0 || s.transmission > 0.0);
  s.shadingNormal = isReflector ? keepMirrorOutside(facing, s.geometricNormal, direction)
                                : keepOnRaySide(facing, s.geometricNormal, direction);
  if (kHasClearcoat) {
    s.coatNormal = keepMirrorOutside(s.isFront ? coatNormal : -coatNormal, s.geometricNormal, direction);
    s.coatCosOut = -dot(s.coatNormal, direction);
  }
  s.frame = frameAround(s.shadingNormal);
  s.backwards = -direction;
  s.mapNormal = s.geometricNormal;
  s.sheetDepth = vec3(0.0);
  if (kHasLayers) loadLayers(s, base, t, tangent, normal);
  s.canEmit = (s.flags & kMaterialEmissive) != 0u && (s.isFront || (s.flags & kMaterialDoubleSided) != 0u);
  s.specularColor = specularColor;
  s.specular = specular;
  return s;
}

#endif
