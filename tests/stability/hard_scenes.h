/// Scenes of more than one test of hard cases.
#pragma once
#include "support/scene_builder.h"

namespace importon::test {

/// Two closed spheres of albedo 0.5 and radius 1 m; in the camera's one a light of 1 W/sr, in the other one of 1e8
/// W/sr.
[[nodiscard]] inline Scene sphereBesideStrongLight(int size) {
  SceneBuilder builder;
  const uint walls = builder.material(diffuse(vec3(0.5f)));
  builder.icosphere(walls, {0, 0, 0}, 1, 3, Facing::inside, Shading::flat);
  builder.icosphere(walls, {3, 0, 0}, 1, 3, Facing::inside, Shading::flat);
  builder.pointLight({0, 0, 0}, vec3(1.0f));
  builder.pointLight({3, 0, 0}, vec3(1e8f));
  builder.camera({0.1, 0.2, 0.5}, {0, 0, -1}, 1.0, size, size);
  return builder.finish();
}

}  // namespace importon::test
