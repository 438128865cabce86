// Vertices of placed meshes.
#ifndef IMPORTON_LIB_PLACED_POINT_GLSL
#define IMPORTON_LIB_PLACED_POINT_GLSL

/// A vertex of a mesh in render space by the rows of renderFromObject: exactly these floats, wherever it is asked for.
/// So rays that leave a triangle start off the same one that they were traced against, and triangles that share a
/// vertex go on to share it.
vec3 placedPoint(vec4 x, vec4 y, vec4 z, vec3 v) {
  precise vec3 placed;
  placed.x = ((x.x * v.x + x.y * v.y) + x.z * v.z) + x.w;
  placed.y = ((y.x * v.x + y.y * v.y) + y.z * v.z) + y.w;
  placed.z = ((z.x * v.x + z.y * v.y) + z.z * v.z) + z.w;
  return placed;
}

#endif
