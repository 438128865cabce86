/// A lamp with a profile in a scene made in memory.
#pragma once
#include "scene/profiles/light_profile.h"
#include "scene/scene.h"

namespace importon::test {

/// Makes of the last light, which stands where it did, one that shines along `direction` by the profile. The scene has
/// no other textures.
inline Light& shineByProfile(Scene& scene, const LightProfile& profile, const vec3& direction) {
  scene.textures = {textureOf(profile, 0)};
  scene.texels = profile.texels;
  Light light = lightOf(profile, 0, vec3(1.0f));
  light.position = scene.lights.back().position;
  light.direction = direction;
  return scene.lights.back() = light;
}

}  // namespace importon::test
