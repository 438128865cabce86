// What a scene is on the device: plain arrays of these structs. Lengths are in the scene's unit
// (glTF: metres), positions in render space (the world less Scene::worldFromRender), colours linear RGB.
#ifndef IMPORTON_SHARED_SCENE_DATA_H
#define IMPORTON_SHARED_SCENE_DATA_H
#include "glsl_compat.h"

SHARED_BEGIN

SHARED_CONST uint kNone = 0xFFFFFFFFu;

/// Where the tables start that share a buffer (bindings/tables.glsl), in texels of 16 bytes or in words; those of the
/// first of each are 0.
struct TableStarts {
  uint materials;
  uint textures;
  uint lights;
  uint lightTree;
  uint instanceOfPage;
  uint lightOfTriangle;
};

/// Shading attributes of a vertex; its position is kept apart, for the BVH.
struct Vertex {
  vec2 uv0;
  vec2 uv1;
  uint normal;   // octahedral, two snorm16 (lib/packing.glsl); kNone: the mesh has none, shade flat
  uint tangent;  // octahedral, snorm16 and snorm15, lowest bit 1: bitangent sign negative; kNone: none
  uint colorRG;  // COLOR_0, half floats, linear
  uint colorBA;
};

/// Indices into the vertex arrays (counter-clockwise front face) and the material.
struct Triangle {
  uint v0;
  uint v1;
  uint v2;
  uint material;
};

// Numbers of triangles, as hits have them. Those of the world, up to the first mesh, are numbered as in the scene's
// array. A triangle of a placed mesh has the number kPlacedTriangle + page · kPageTriangles + place in the page: the
// pages of all instances are counted together, and each mesh's triangles fill pages of their own.
SHARED_CONST uint kPlacedTriangle = 0x80000000u;
SHARED_CONST uint kPageBits = 10u;
SHARED_CONST uint kPageTriangles = 1u << kPageBits;
SHARED_CONST uint kMostPages = (kPlacedTriangle >> kPageBits) - 1u;

/// Where a mesh stands. The first one of the array stands for the world, where nothing is moved. Its placed vertices
/// are exactly what float arithmetic makes of renderFromObject (lib/placed_point.glsl).
struct InstanceData {
  vec4 renderFromObject[3];  // rows
  vec4 objectFromRender[3];
  vec3 reach;          // m: no coordinate of the placed mesh is greater, nor is a sum of the terms that make it
  uint firstNumber;    // of its first triangle
  uint firstTriangle;  // in the scene's array
  uint root;           // record of its tree
  uint isMirrored;     // the front of its triangles is clockwise once they are placed
  uint unused;
};
SHARED_CONST uint kInstanceTexels = 8u;

// Material::flags
SHARED_CONST uint kMaterialDoubleSided = 1u;
SHARED_CONST uint kMaterialUnlit = 2u;
SHARED_CONST uint kMaterialAlphaMask = 4u;
SHARED_CONST uint kMaterialAlphaBlend = 8u;
SHARED_CONST uint kMaterialSolid = 16u;  // KHR_materials_volume with thickness > 0: an interface of a solid
SHARED_CONST uint kMaterialEmissive = 32u;
SHARED_CONST uint kMaterialPane = 64u;  // smooth and thin: what it transmits goes straight on; device only

/// The glTF 2.0 metallic-roughness material and its extensions. Textures are indices into the texture
/// array or kNone; a texture multiplies its factor as glTF says.
struct Material {
  vec4 baseColor;  // factor; alpha in w
  vec3 emission;   // W/(m² sr), emissiveFactor · emissiveStrength
  float metallic;
  vec3 specularColor;  // KHR_materials_specular specularColorFactor
  float roughness;     // perceptual; alpha = roughness²
  vec3 absorption;     // KHR_materials_volume: -ln(attenuationColor)/attenuationDistance, 1/m
  float transmission;
  float ior;
  float specular;  // KHR_materials_specular specularFactor
  float normalScale;
  float alphaCutoff;
  float clearcoat;
  float clearcoatRoughness;
  uint flags;
  uint baseColorTexture;
  uint metallicRoughnessTexture;  // g: roughness, b: metallic
  uint normalTexture;
  uint emissiveTexture;
  uint transmissionTexture;        // r
  uint specularTexture;            // a
  uint specularColorTexture;       // rgb, sRGB
  uint clearcoatTexture;           // r
  uint clearcoatRoughnessTexture;  // g
  uint clearcoatNormalTexture;
  float clearcoatNormalScale;
  uint medium;  // of a solid: 1 .. kMostMedia, the same for equal index, dispersion and absorption; else 0; device only
  uint materialOfMedium;          // in the m-th material: one whose solids are of the medium m + 1; device only
  vec3 diffuseTransmissionColor;  // KHR_materials_diffuse_transmission
  float diffuseTransmission;
  vec3 sheenColor;  // KHR_materials_sheen
  float sheenRoughness;
  float anisotropy;          // KHR_materials_anisotropy anisotropyStrength
  float anisotropyRotation;  // rad, from the tangent towards the bitangent
  float iridescence;         // KHR_materials_iridescence
  float iridescenceIor;
  float iridescenceThicknessMinimum;     // nm, where the thickness texture is 0
  float iridescenceThicknessMaximum;     // nm, where it is 1, or there is none
  float dispersion;                      // KHR_materials_dispersion: 20 over the Abbe number
  float thickness;                       // KHR_materials_volume thicknessFactor, m; of a sheet where flags say no solid
  uint diffuseTransmissionTexture;       // a
  uint diffuseTransmissionColorTexture;  // rgb, sRGB
  uint sheenColorTexture;                // rgb, sRGB
  uint sheenRoughnessTexture;            // a
  uint anisotropyTexture;                // rg: direction in tangent space; b: strength
  uint iridescenceTexture;               // r
  uint iridescenceThicknessTexture;      // g
  uint thicknessTexture;                 // g
};
SHARED_CONST uint kMaterialTexels = 15u;

SHARED_CONST uint kMostMedia = 255u;

// Texture::wrapS, wrapT
SHARED_CONST uint kWrapRepeat = 0u;
SHARED_CONST uint kWrapClamp = 1u;
SHARED_CONST uint kWrapMirror = 2u;

/// A use of an image: sampler, colour meaning, UV set and KHR_texture_transform.
struct Texture {
  uint firstTexel;  // into the texel array, in words; RGBA with red in the low byte, rows from the top
  uint width;
  uint height;
  uint wrapS;
  uint wrapT;
  uint isNearest;  // 1: no interpolation
  uint isSrgb;     // 1: rgb decode from sRGB
  uint uvSet;      // 0, 1
  uint isDeep;     // 1: RGBA16, two words a texel, red and green first; 0: RGBA8
  vec3 uvRow0;     // u' = dot(uvRow0, (u, v, 1))
  vec3 uvRow1;
};

// Light::kind
SHARED_CONST uint kLightTriangle = 0u;
SHARED_CONST uint kLightPoint = 1u;
SHARED_CONST uint kLightSpot = 2u;
SHARED_CONST uint kLightDirectional = 3u;
SHARED_CONST uint kLightEnvironment = 4u;
SHARED_CONST uint kLightProfile = 5u;

/// One light. glTF's candela and lux are taken as W/sr and W/m² per channel.
struct Light {
  uint kind;
  uint triangle;    // kLightTriangle: index of the emissive triangle; profile: of the texture of its shares
  float power;      // W, mean of the channels: what it emits in all; weight for choosing lights
  float area;       // m², of one side; profile: angle of the lamp's x in the frame around `direction`, rad
  vec3 emission;    // triangle: mean radiance W/(m² sr); point, spot: W/sr; profile: the greatest, W/sr; directional:
                    // W/m²; environment: W/(m² sr)
  vec3 position;    // point, spot, profile; triangle: its centroid
  float cosInner;   // spot
  vec3 direction;   // spot, profile, directional: where the light goes; triangle: normal of the front; unit length
  float cosOuter;   // spot, profile: no light beyond
  uint isTwoSided;  // triangle: 1 if both sides emit; profile: 1 if it is mirrored
};

SHARED_END
#endif
