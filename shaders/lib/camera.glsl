// Camera rays.
#ifndef IMPORTON_LIB_CAMERA_GLSL
#define IMPORTON_LIB_CAMERA_GLSL

/// The ray through image position p (pixels, from the upper left corner), tMax infinite.
Ray cameraRay(Parameters params, vec2 p) {
  const vec2 q = vec2(2.0 * p.x / float(params.width) - 1.0, 1.0 - 2.0 * p.y / float(params.height));
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

#endif
