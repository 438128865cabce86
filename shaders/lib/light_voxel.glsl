// Voxels of the scene that remember which lights reach them, one bit a light, as photons show it.
#ifndef IMPORTON_LIB_LIGHT_VOXEL_GLSL
#define IMPORTON_LIB_LIGHT_VOXEL_GLSL
#include "shared/render_data.h"

/// The voxels are shifted, so that the scene's outermost planes and those at round places do not lie between two: a point
/// and the start of a ray from it, off the surface by its rounding error, must see the same lights.
uint lightVoxel(vec3 position, vec3 origin, float extent) {
  const float voxels = float(kLightVoxels);
  const uvec3 at = uvec3(clamp((position - origin) * ((voxels - 1.0) / extent) + 0.37, vec3(0.0), vec3(voxels - 1.0)));
  return at.x + kLightVoxels * (at.y + kLightVoxels * at.z);
}

#endif
