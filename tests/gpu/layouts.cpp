// To add a struct of shaders/shared: one IMPORTON_LAYOUT line with its name and all its members in order. A
// struct that lies in a buffer or in push constants of a shipped kernel and is not here fails the layout test.
#include "gpu/layout.h"
#include "shared/ray_data.h"
#include "shared/scene_data.h"

namespace importon::test {

std::vector<HostLayout> hostLayouts() {
  return {
      // shared/scene_data.h
      IMPORTON_LAYOUT(Vertex, uv0, uv1, normal, tangent, colorRG, colorBA),
      IMPORTON_LAYOUT(Triangle, v0, v1, v2, material),
      IMPORTON_LAYOUT(Material, baseColor, emission, metallic, specularColor, roughness, absorption,
                      transmission, ior, specular, normalScale, alphaCutoff, clearcoat, clearcoatRoughness,
                      flags, baseColorTexture, metallicRoughnessTexture, normalTexture, emissiveTexture,
                      transmissionTexture, specularTexture, specularColorTexture, clearcoatTexture,
                      clearcoatRoughnessTexture),
      IMPORTON_LAYOUT(Texture, firstTexel, width, height, wrapS, wrapT, isNearest, isSrgb, uvSet, uvRow0,
                      uvRow1),
      IMPORTON_LAYOUT(Light, kind, triangle, power, area, emission, range, position, cosInner, direction,
                      cosOuter, isTwoSided),
      // shared/ray_data.h
      IMPORTON_LAYOUT(Ray, origin, tMax, direction, id),
      IMPORTON_LAYOUT(Hit, t, u, v, triangle),
  };
}

}  // namespace importon::test
