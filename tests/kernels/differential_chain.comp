// A path through smooth surfaces, with its differential, and the same path moved by small steps. It reflects where
// the item says so, else refracts; all triangles are tried.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings/scene.glsl"
#include "lib/bsdf.glsl"
#include "lib/differential.glsl"
#include "lib/path.glsl"

struct Item {
  vec3 origin;
  uint events;       // before the last surface
  vec3 direction;    // not of unit length
  uint reflections;  // a bit for each event
  vec3 stepX;        // of the direction
  vec3 stepY;
};
struct Moved {
  vec3 position;
  uint triangles;  // a hash of those on the way; 0: the path was lost
};
struct Result {
  Moved base, lowX, highX, lowY, highY;
  vec3 slopeX, slopeY;
};

layout(scalar) readonly buffer In { Item items[]; };
layout(scalar) writeonly buffer Out { Result results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

/// Barycentric weights and distance of the hit, which is kInfinity where there is none. [Möller and Trumbore 1997]
vec3 meetTriangle(uint triangle, vec3 origin, vec3 direction) {
  const uvec4 v = triangleTexel(triangle);
  const vec3 a = vertexPosition(v.x), e1 = vertexPosition(v.y) - a, e2 = vertexPosition(v.z) - a;
  const vec3 p = cross(direction, e2), q = cross(origin - a, e1);
  const float inverse = 1.0 / dot(e1, p), u = dot(origin - a, p) * inverse, w = dot(direction, q) * inverse;
  const float t = dot(e2, q) * inverse;
  return vec3(u, w, u >= 0.0 && w >= 0.0 && u + w <= 1.0 && t > 1e-3 ? t : kInfinity);
}

Moved follow(Item item, vec3 direction, inout PathDifferential d) {
  Moved moved = Moved(item.origin, 1u);
  direction = normalize(direction);
  for (uint event = 0u; event <= item.events; ++event) {
    vec3 nearest = vec3(kInfinity);
    uint triangle = kNone;
    for (uint k = 0u; k < uint(textureSize(trianglesTexels)); ++k) {
      const vec3 hit = meetTriangle(k, moved.position, direction);
      if (hit.z < nearest.z) {
        nearest = hit;
        triangle = k;
      }
    }
    if (triangle == kNone) return Moved(moved.position, 0u);
    const Surface s = loadSurface(triangle, nearest.xy, direction);
    moved = Moved(s.position, hash(moved.triangles + triangle));
    transferDifferential(d, nearest.z, direction, s.geometricNormal);
    if (event == item.events) break;
    const Bsdf b = makeBsdf(s, -dot(direction, s.shadingNormal));
    SpecularEvent e = SpecularEvent(direction, s.shadingNormal, b.eta, (item.reflections >> event & 1u) == 0u, 0.0);
    bendDifferential(d, e, loadNormalField(triangle, nearest.xy, s.isFront));
    const vec3 wo = -direction;
    if (!e.isTransmission) direction = reflect(direction, s.shadingNormal);
    else if (!refractLocal(wo, s.shadingNormal, b.eta, direction)) return Moved(moved.position, 0u);
    direction = normalize(direction);
  }
  return moved;
}

vec3 slopeOfUnit(vec3 direction, vec3 step) {
  const vec3 unit = normalize(direction);
  return (step - unit * dot(unit, step)) / length(direction);
}

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Item item = items[i];
  const Spread none = Spread(vec3(0.0), vec3(0.0), 0.0);
  PathDifferential d = PathDifferential(none, none, none, none, 1.0), unused = d;
  d.x.direction = slopeOfUnit(item.direction, item.stepX);
  d.y.direction = slopeOfUnit(item.direction, item.stepY);
  Result r;
  r.base = follow(item, item.direction, d);
  r.slopeX = d.x.position;
  r.slopeY = d.y.position;
  r.lowX = follow(item, item.direction - item.stepX, unused);
  r.highX = follow(item, item.direction + item.stepX, unused);
  r.lowY = follow(item, item.direction - item.stepY, unused);
  r.highY = follow(item, item.direction + item.stepY, unused);
  results[i] = r;
}
