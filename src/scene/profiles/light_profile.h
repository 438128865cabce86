/// A lamp's profile as the device reads it.
#pragma once
#include <vector>

#include "scene/profiles/ies_file.h"
#include "shared/scene_data.h"

namespace importon {

/// The share of the greatest intensity over all directions, as a texture of 16 bits: across, the angle around the
/// lamp's axis from x towards y; down, the angle from the axis, -z.
struct LightProfile {
  int width = 1, height = 1;
  std::vector<uint> texels;  // two words each, all channels alike
  double most = 0;           // cd
  double shareIntegral = 0;  // sr, of the share over all directions
  float cosOuter = -1;       // no light beyond this angle to the axis
};

[[nodiscard]] LightProfile sampleProfile(const IesProfile& profile);

/// Its texture, with `firstTexel` as its place among the scene's.
[[nodiscard]] Texture textureOf(const LightProfile& profile, uint firstTexel);

/// A light of it, at `factor` times its candela, whose texture has the number `texture`. Where it stands and looks is
/// to be set: placeLight.
[[nodiscard]] Light lightOf(const LightProfile& profile, uint texture, const vec3& factor);

}  // namespace importon
