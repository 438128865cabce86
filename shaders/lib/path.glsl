// What eye paths and photons do alike at a surface.
#ifndef IMPORTON_LIB_PATH_GLSL
#define IMPORTON_LIB_PATH_GLSL
#include "lib/bsdf.glsl"
#include "lib/path_pairs.glsl"

/// Beer's law over a segment of length t in the path's medium. A path that does not know its medium (it started
/// inside a solid) learns it from the back face that it meets.
vec3 mediumTransmittance(uint medium, Surface s, float t) {
  if (medium != kNone) return exp(-uintBitsToFloat(materialTexel(8u * medium + 3u)).rgb * t);
  const bool leavesSolid = !s.isFront && (s.flags & kMaterialSolid) != 0u && s.transmission > 0.0;
  return leavesSolid ? exp(-s.absorption * t) : vec3(1.0);
}

/// The medium after an event at s.
uint mediumBehind(uint medium, Surface s, bool isTransmission) {
  if (!isTransmission || (s.flags & kMaterialSolid) == 0u) return medium;
  return s.isFront ? s.material : kNone;
}

/// Start of the next ray: off the surface by its error bound, on the side of `direction`.
Ray nextRay(Surface s, vec3 direction, uint id) {
  Ray ray;
  ray.origin = offsetOrigin(s.position, s.error, s.geometricNormal, direction);
  ray.tMax = kInfinity;
  ray.direction = direction;
  ray.id = id;
  return ray;
}

/// True if a sampled direction lies on the side of the geometric surface that its lobe means.
bool isConsistent(Surface s, vec3 direction, bool isTransmission) {
  return (dot(direction, s.geometricNormal) > 0.0) != isTransmission;
}

#endif
