// Camera rays.
#ifndef IMPORTON_LIB_CAMERA_GLSL
#define IMPORTON_LIB_CAMERA_GLSL
#include "lib/sampling.glsl"

/// The ray through position p of the whole image (pixels, from the upper left corner), tMax infinite.
Ray cameraRay(Parameters params, vec2 p) {
  const vec2 q = vec2(2.0 * p.x / float(params.imageSize.x) - 1.0, 1.0 - 2.0 * p.y / float(params.imageSize.y));
  const vec3 across = q.x * params.cameraRight + q.y * params.cameraUp;
  Ray ray;
  ray.tMax = kInfinity;
  ray.id = 0u;
  if (params.cameraIsOrthographic != 0u) {
    ray.origin = params.cameraOrigin + across;
    ray.direction = params.cameraForward;
  } else {
    ray.origin = params.cameraOrigin;
    ray.direction = normalize(params.cameraForward + across);
  }
  return ray;
}

bool hasLens(Parameters params) { return params.lensRight != vec3(0.0); }

/// The ray of a pinhole, from a place on the lens drawn by u instead: both meet where the image is in focus.
/// [Cook, Porter and Carpenter 1984, Distributed Ray Tracing]
void throughLens(Parameters params, vec2 u, inout Ray ray) {
  const vec2 place = sampleDisc(u);
  const vec3 onLens = place.x * params.lensRight + place.y * params.lensUp;
  const vec3 toOneMetre = ray.direction / dot(ray.direction, params.cameraForward);
  ray.origin += onLens;
  ray.direction = normalize(toOneMetre - onLens * params.inverseFocus);
}

/// How the ray of unit `direction` moves with its place in the image, by steps of a pixel, and on the lens, by steps to
/// the neighbours among all paths of a pixel and pass.
PathDifferential cameraDifferential(Parameters params, vec3 direction) {
  const vec3 right = params.cameraRight * (2.0 / float(params.imageSize.x)),
             down = params.cameraUp * (-2.0 / float(params.imageSize.y));
  const Spread none = Spread(vec3(0.0), vec3(0.0), 0.0);
  PathDifferential d = PathDifferential(none, none, none, none, 1.0);
  if (params.cameraIsOrthographic != 0u) {
    d.x.position = right;
    d.y.position = down;
  } else {
    const float perLength = dot(direction, params.cameraForward);
    d.x.direction = (right - direction * dot(direction, right)) * perLength;
    d.y.direction = (down - direction * dot(direction, down)) * perLength;
    if (hasLens(params)) {
      const float step = sqrt(kPi / float(params.samplesPerPass));  // so many squares are as large as the disc
      d.u.position = params.lensRight * step;
      d.v.position = params.lensUp * step;
      const vec3 u = d.u.position * -params.inverseFocus, v = d.v.position * -params.inverseFocus;
      d.u.direction = (u - direction * dot(direction, u)) * perLength;
      d.v.direction = (v - direction * dot(direction, v)) * perLength;
    }
  }
  return d;
}

#endif
