// Voxels of the scene that remember which lights reach them, one bit a light or a group of lights, as photons show it.
// What lib/light_tree.glsl asks for comes before this file.
#ifndef IMPORTON_LIB_LIGHT_VOXEL_GLSL
#define IMPORTON_LIB_LIGHT_VOXEL_GLSL
#include "lib/light_tree.glsl"
#include "shared/render_data.h"

// Steps of two by which the voxels are larger where they know groups of lights: there are more bits to find by as many
// photons, and what is not found yet is noise.
const uint kCoarserForGroups = 2u;

/// The voxels are shifted, so that the scene's outermost planes and those at round places do not lie between two: a
/// point and the start of a ray from it, off the surface by its rounding error, must see the same lights.
uint lightVoxel(vec3 position, vec3 origin, float extent, uint lights) {
  const float voxels = float(kLightVoxels);
  const uint coarser = lights > kLinearLights ? kCoarserForGroups : 0u;
  const uvec3 at =
      uvec3(clamp((position - origin) * ((voxels - 1.0) / extent) + 0.37, vec3(0.0), vec3(voxels - 1.0))) >> coarser;
  return at.x + kLightVoxels * (at.y + kLightVoxels * at.z);
}

#endif
