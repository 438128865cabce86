// Path differentials: how a vertex and the ray that leaves it move with the variables that made the path. Exact
// through specular events; a sampled direction brings variables of its own. [Igehy 1999; Suykens and Willems 2001]
// The kernel includes lib/bsdf.glsl before this file.
#ifndef IMPORTON_LIB_DIFFERENTIAL_GLSL
#define IMPORTON_LIB_DIFFERENTIAL_GLSL

/// Over a segment of length t (m) along `direction` to a surface of `normal` (geometric). [Igehy 1999, eq. 10 to 12]
void transferSpread(inout Spread s, float t, vec3 direction, vec3 normal) {
  const vec3 q = s.position + t * s.direction;
  const float cosine = dot(direction, normal);
  s.position = q - direction * (dot(q, normal) / (abs(cosine) < 1e-4 ? 1e-4 : cosine));
}

/// `normalSlope`: derivative of the shading normal `normal` along s.position. [Igehy 1999, eq. 15]
void reflectSpread(inout Spread s, vec3 direction, vec3 normal, vec3 normalSlope) {
  const float cosineSlope = dot(s.direction, normal) + dot(direction, normalSlope);
  s.direction -= 2.0 * (dot(direction, normal) * normalSlope + cosineSlope * normal);
}

/// `normal` faces the ray; eta = index behind over index in front; no total reflection. [Igehy 1999, eq. 17 to 19]
void refractSpread(inout Spread s, vec3 direction, vec3 normal, vec3 normalSlope, float eta) {
  const float inverse = 1.0 / eta, cosine = dot(direction, normal);
  const float refracted = -sqrt(max(1.0 - inverse * inverse * (1.0 - cosine * cosine), 1e-8));
  const float mu = inverse * cosine - refracted;
  const float cosineSlope = dot(s.direction, normal) + dot(direction, normalSlope);
  const float muSlope = (inverse - inverse * inverse * cosine / refracted) * cosineSlope;
  s.direction = inverse * s.direction - mu * normalSlope - muSlope * normal;
}

/// How the shading normal turns over a triangle: its derivative along dP is slope1 (dual1 · dP) + slope2 (dual2 · dP).
struct NormalField {
  vec3 dual1, dual2;    // gradients of the barycentric weights of v1 and v2, 1/m
  vec3 slope1, slope2;  // derivatives of the unit normal by them
};

/// On the side of the ray. Normal maps are left out.
NormalField loadNormalField(uint triangle, vec2 uv, bool isFront) {
  NormalField f = NormalField(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  uint stored;
  const Placement place = findPlacement(triangle, stored);
  const uvec4 indices = triangleTexel(stored);
  const uvec4 t0 = vertexTexel(3u * indices.x), t1 = vertexTexel(3u * indices.y), t2 = vertexTexel(3u * indices.z);
  if (t0.w == kNone || t1.w == kNone || t2.w == kNone) return f;
  const vec3 p0 = placedVertex(place, uintBitsToFloat(t0.xyz));
  const vec3 e1 = placedVertex(place, uintBitsToFloat(t1.xyz)) - p0,
             e2 = placedVertex(place, uintBitsToFloat(t2.xyz)) - p0;
  const float size = max(maxComponent(abs(e1)), maxComponent(abs(e2)));  // squares of small edges may underflow
  const vec3 a = e1 / size, b = e2 / size, across = cross(a, b);
  const float area2 = dot(across, across);
  const vec3 n0 = placedNormal(place, unpackNormal(t0.w)), n1 = placedNormal(place, unpackNormal(t1.w)) - n0,
             n2 = placedNormal(place, unpackNormal(t2.w)) - n0;
  const vec3 sum = n0 + uv.x * n1 + uv.y * n2;
  if (!(area2 > 1e-20) || dot(sum, sum) <= 1e-12) return f;
  f.dual1 = cross(b, across) / (area2 * size);
  f.dual2 = cross(across, a) / (area2 * size);
  const float inverse = inversesqrt(dot(sum, sum)), side = isFront ? inverse : -inverse;
  const vec3 n = sum * inverse;
  f.slope1 = (n1 - n * dot(n, n1)) * side;
  f.slope2 = (n2 - n * dot(n, n2)) * side;
  return f;
}

vec3 normalSlope(NormalField f, vec3 dP) { return f.slope1 * dot(f.dual1, dP) + f.slope2 * dot(f.dual2, dP); }

/// A smooth surface, and the event that the path has there.
struct SpecularEvent {
  vec3 direction;      // of the ray that came
  vec3 normal;         // shading normal, facing it
  float eta;           // index behind over index in front; 1: light that passes goes straight on
  bool isTransmission;
  float weightSlope;   // derivative of the logarithm of the event's weight by the cosine of the angle to the normal
};

void bendSpread(inout Spread s, SpecularEvent e, NormalField field) {
  const vec3 slope = normalSlope(field, s.position);
  s.gradient -= e.weightSlope * (dot(s.direction, e.normal) + dot(e.direction, slope));
  if (!e.isTransmission) reflectSpread(s, e.direction, e.normal, slope);
  else if (e.eta != 1.0) refractSpread(s, e.direction, e.normal, slope, e.eta);
}

void bendDifferential(inout PathDifferential d, SpecularEvent e, NormalField field) {
  bendSpread(d.x, e, field);
  bendSpread(d.y, e, field);
  bendSpread(d.u, e, field);
  bendSpread(d.v, e, field);
}

void transferDifferential(inout PathDifferential d, float t, vec3 direction, vec3 normal) {
  transferSpread(d.x, t, direction, normal);
  transferSpread(d.y, t, direction, normal);
  transferSpread(d.u, t, direction, normal);
  transferSpread(d.v, t, direction, normal);
}

/// Where to the next path the weight would change by more than itself, the footprint ends earlier.
/// [Suykens and Willems 2001, section 4.3]
vec3 limitedSpread(Spread s) { return s.position / max(1.0, abs(s.gradient)); }

/// m², of the vectors' footprint: the root of the determinant of their covariance, which for two of them is the area of
/// their parallelogram.
float footprintArea(PathDifferential d) {
  const vec3 x = limitedSpread(d.x), y = limitedSpread(d.y), u = limitedSpread(d.u), v = limitedSpread(d.v);
  const vec3 a = cross(x, y), b = cross(u, v), c = cross(x, u), e = cross(x, v), f = cross(y, u), g = cross(y, v);
  return sqrt(dot(a, a) + dot(b, b) + dot(c, c) + dot(e, e) + dot(f, f) + dot(g, g));
}

/// A sampled direction on a surface of `normal`: what the path covers so far goes into two vectors of the same
/// covariance, which turn with the surface; `stepU` and `stepV` lead from `direction`, the next ray's, to its
/// neighbours.
void scatterDifferential(inout PathDifferential d, vec3 normal, NormalField field, vec3 direction, Spread stepU,
                         Spread stepV) {
  const mat3 frame = frameAround(normal);
  const vec2 x = (limitedSpread(d.x) * frame).xy, y = (limitedSpread(d.y) * frame).xy;
  const vec2 u = (limitedSpread(d.u) * frame).xy, v = (limitedSpread(d.v) * frame).xy;
  const float xx = x.x * x.x + y.x * y.x + u.x * u.x + v.x * v.x;
  const float xy = x.x * x.y + y.x * y.y + u.x * u.y + v.x * v.y;
  const float yy = x.y * x.y + y.y * y.y + u.y * u.y + v.y * v.y;
  const float a = sqrt(xx), b = a > 0.0 ? xy / a : 0.0, c = sqrt(max(yy - b * b, 0.0));  // Cholesky
  d.x.position = frame * vec3(a, b, 0.0);
  d.y.position = frame * vec3(0.0, c, 0.0);
  d.x.direction = cross(cross(normal, normalSlope(field, d.x.position)), direction);
  d.y.direction = cross(cross(normal, normalSlope(field, d.y.position)), direction);
  d.x.gradient = d.y.gradient = 0.0;
  d.u = stepU;
  d.v = stepV;
}

#endif
