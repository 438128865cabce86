// What eye paths and photons do alike at a surface.
#ifndef IMPORTON_LIB_PATH_GLSL
#define IMPORTON_LIB_PATH_GLSL
#include "lib/bsdf.glsl"
#include "lib/path_pairs.glsl"

/// Beer's law over a segment of length t in the path's medium. A path that does not know its medium (it started
/// inside a solid) learns it from the back face that it meets.
vec3 mediumTransmittance(uint medium, Surface s, float t) {
  if (medium != kNone) return exp(-uintBitsToFloat(materialTexel(kMaterialTexels * medium + 3u)).rgb * t);
  return !s.isFront && (s.flags & kMaterialSolid) != 0u && s.transmission > 0.0 ? exp(-s.absorption * t) : vec3(1.0);
}

bool isSolidInterface(Surface s) { return (s.flags & kMaterialSolid) != 0u && s.transmission > 0.0; }

/// Index of refraction of the inside of a material's solid; kNone: air.
float mediumIndex(uint medium) {
  return medium == kNone ? 1.0 : uintBitsToFloat(materialTexel(kMaterialTexels * medium + 4u).x);
}

// Nested dielectrics: where solids overlap, the one that the path entered last is there. So a liquid that reaches a
// little into its glass, a glass ball in water and a bubble as a solid of air all come out right.

/// Makes a solid's index relative to what is outside it. The surface of a solid that is not there does nothing.
void relateIndex(inout Surface s, PathState path) {
  if (!kHasTransmission || !isSolidInterface(s)) return;
  if (s.isFront) {
    s.ior /= mediumIndex(path.medium);
  } else if (path.medium == s.material) {
    s.ior /= mediumIndex(path.outerMedium);
  } else if (path.medium != kNone) {
    s.ior = 1.0;
  }
}

/// The path's media after an event at s.
void updateMedium(inout PathState path, Surface s, bool isTransmission) {
  if (!isTransmission || !isSolidInterface(s)) return;
  if (s.isFront) {
    path.outerMedium = path.medium;
    path.medium = s.material;
  } else if (path.medium == s.material || path.medium == kNone) {
    path.medium = path.outerMedium;
    path.outerMedium = kNone;
  } else if (path.outerMedium == s.material) {
    path.outerMedium = kNone;
  }
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

/// Beyond it the normals contradict each other; the rest would come as a few very bright photons.
const float kMaxAdjoint = 4.0;

/// Factor of a photon that scatters where shading and geometric normal differ [Veach 1997, eq. 5.19]: it travels along
/// `direction` and leaves along `wi`; the cosines are those of the shading normal with where it came from and with wi.
float adjointFactor(Surface s, vec3 direction, float cosCame, vec3 wi, float cosLeaves) {
  const float adjoint = abs(cosCame * dot(wi, s.geometricNormal)) /
                        max(abs(dot(direction, s.geometricNormal) * cosLeaves), 1e-20);
  return min(adjoint, kMaxAdjoint);
}

/// True if a sampled direction lies on the side of the geometric surface that its lobe means.
bool isConsistent(Surface s, vec3 direction, bool isTransmission) {
  return (dot(direction, s.geometricNormal) > 0.0) != isTransmission;
}

#endif
