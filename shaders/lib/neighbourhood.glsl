// The nearest points of a grid in which every point stands at several levels. The kernel defines countedDistance:
// lib/nearest.glsl.
#ifndef IMPORTON_LIB_NEIGHBOURHOOD_GLSL
#define IMPORTON_LIB_NEIGHBOURHOOD_GLSL
#include "lib/nearest.glsl"

const uint kFinestShift = 15u;  // of the shell: 2^-15 of the squared radius

const uint kAFew = 4u;

/// What is found around a point.
struct Neighbourhood {
  Walk walk;
  float radius;  // m
  Shell shell;
  bool isFull;  // M points are in the shell or nearer
  bool isLast;  // else: coarser levels would not do better
};

void beginLevel(inout Neighbourhood n, GridFrame frame, vec3 centre, vec3 normal, uint level) {
  n.radius = gridCellEdge(frame, level);
  n.walk = beginWalkLevels(frame, centre, normal, n.radius, 1u << level);
  n.shell = beginShell(n.radius);
}

/// The finest cells that hold M points around a centre, so that few more are looked at. Where they have too many to
/// look through, of other surfaces or beside a much denser place, those of a finer level that hold a few do instead.
/// Without such a level some of the points stand for all.
Neighbourhood findNearest(GridFrame frame, vec3 centre, vec3 normal, uint levels, uint nearest) {
  const uint mostPoints = mostPointsOf(levels);
  Neighbourhood n;
  n.isFull = n.isLast = false;
  uint last = kNone, found = 0u;
  while (levels != 0u && !n.isFull) {
    const uint level = uint(findMSB(levels));
    beginLevel(n, frame, centre, normal, level);
    thin(n.walk, mostPoints);
    n.isLast = found >= kAFew && n.walk.stride > 1u;
    if (n.isLast) break;
    n.isFull = narrow(n.walk, normal, n.radius, nearest, n.shell);
    found = n.shell.inner;
    levels ^= 1u << level;
    last = level;
  }
  if (n.isLast) {
    beginLevel(n, frame, centre, normal, last);
    thin(n.walk, mostPoints);
  }
  while (n.isFull && n.shell.between > 1u && n.shell.shift > kFinestShift)
    narrow(n.walk, normal, n.radius, nearest, n.shell);
  return n;
}

#endif
