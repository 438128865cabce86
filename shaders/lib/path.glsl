// What eye paths and photons do alike at a surface.
#ifndef IMPORTON_LIB_PATH_GLSL
#define IMPORTON_LIB_PATH_GLSL
#include "lib/bsdf.glsl"
#include "lib/dispersion.glsl"
#include "lib/hash.glsl"
#include "lib/media.glsl"
#include "lib/path_pairs.glsl"
#include "shared/elementary.h"

bool isSolidInterface(Surface s) {
  if ((s.flags & kMaterialSolid) == 0u) return false;
  return s.transmission > 0.0 || (kHasDiffuseTransmission && s.diffuseTransmission > 0.0);
}

/// A material whose solids are of a medium.
uint materialOfMedium(uint medium) { return materialTexel(kMaterialTexels * (medium - 1u) + 8u).w; }

/// Beer's law over a segment of length t in the innermost of the path's media. A path that knows none (it started
/// inside a solid) learns it from the back face that it meets.
vec3 mediumTransmittance(uvec2 media, Surface s, float t) {
  const uint medium = innermostMedium(media);
  if (medium != 0u)
    return portableExp(-uintBitsToFloat(materialTexel(kMaterialTexels * materialOfMedium(medium) + 3u)).rgb * t);
  return !s.isFront && isSolidInterface(s) ? portableExp(-s.absorption * t) : vec3(1.0);
}

/// Number of the medium behind the surface of a solid.
uint mediumBehind(Surface s) { return materialTexel(kMaterialTexels * s.material + 8u).z; }

/// Index of refraction of a medium, for the path's channel; 0: air.
float mediumIndex(uint medium, vec3 throughput) {
  if (medium == 0u) return 1.0;
  const uint base = kMaterialTexels * materialOfMedium(medium);
  const float ior = uintBitsToFloat(materialTexel(base + 4u).x);
  if (!kHasDispersion) return ior;
  const float dispersion = uintBitsToFloat(materialTexel(base + 12u).z);
  return dispersion > 0.0 ? dispersedIndex(ior, dispersion, channelOf(throughput)) : ior;
}

const uint kChannelSalt = 0x3D15u;  // tells the choice from others of the same ray

/// At a solid that bends colours differently: the path goes on with one of them, for which the index is then.
/// `ray`: id of the one that met it.
void chooseChannel(inout Surface s, inout PathState path, uint ray, uint pass) {
  if (!kHasDispersion || !isSolidInterface(s) || s.transmission <= 0.0 || s.dispersion <= 0.0) return;
  path.throughput = keepChannel(path.throughput, unitFloat(hashCombine(hashCombine(ray, pass), kChannelSalt)));
  s.ior = dispersedIndex(s.ior, s.dispersion, channelOf(path.throughput));
}

// Nested dielectrics: where solids overlap, the one that the path entered last is there. So a liquid that reaches a
// little into its glass, a glass ball in water and a bubble as a solid of air all come out right.

/// Makes a solid's index relative to what is outside it. The surface of a solid that is not there does nothing.
void relateIndex(inout Surface s, PathState path) {
  if (!kHasTransmission || !isSolidInterface(s)) return;
  const uint here = innermostMedium(path.media);
  if (s.isFront) s.ior /= mediumIndex(here, path.throughput);
  else if (here == mediumBehind(s)) s.ior /= mediumIndex(mediumAround(path.media), path.throughput);
  else if (here != 0u) s.ior = 1.0;
}

/// The path's media after an event at s. True: it is in more solids than it can know.
bool updateMedia(inout PathState path, Surface s, bool isTransmission) {
  if (!isTransmission || !isSolidInterface(s)) return false;
  const bool forgets = s.isFront && isInTooMany(path.media);
  path.media = s.isFront ? enterMedium(path.media, mediumBehind(s)) : leaveMedium(path.media, mediumBehind(s));
  return forgets;
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

/// True of an event that changes neither the path's direction nor what finds its light: shadow rays pass there, too.
bool passesPane(Surface s, BsdfSample sampled) {
  return kHasPanes && (s.flags & kMaterialPane) != 0u && sampled.isDelta && sampled.isTransmission;
}

/// True if a sampled direction lies on the side of the geometric surface that its lobe means.
bool isConsistent(Surface s, vec3 direction, bool isTransmission) {
  return (dot(direction, s.geometricNormal) > 0.0) != isTransmission;
}

#endif
