// Camera rays.
#ifndef IMPORTON_LIB_CAMERA_GLSL
#define IMPORTON_LIB_CAMERA_GLSL

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

/// How the ray of unit `direction` moves with its place in the image, by steps of a pixel.
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
  }
  return d;
}

#endif
