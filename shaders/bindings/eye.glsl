// The steps of kernels/camera/eye_scatter.comp.
#ifndef IMPORTON_BINDINGS_EYE_GLSL
#define IMPORTON_BINDINGS_EYE_GLSL
#include "lib/eye_stream.glsl"
#include "lib/path.glsl"
#include "bindings/irradiance.glsl"

layout(scalar) writeonly buffer ShadowRaysBlock { Ray shadowRays[]; };
layout(scalar) writeonly buffer ShadowLightBlock { vec3 shadowLight[]; };
layout(scalar) writeonly buffer EyeVerticesBlock { EyeVertex eyeVertices[]; };
layout(scalar) writeonly buffer LookupsBlock { uint lookups[]; };

/// Adds light found by the path itself (emitters, environment) to its component.
void addFound(uint slot, PathState path, vec3 radiance) {
  const vec3 light = path.throughput * radiance;
  const bool isCaustic = (path.flags & kPathScattered) != 0u && (path.flags & kPathSpecular) != 0u;
  if ((path.flags & kPathDeep) != 0u) pathLight[slot].indirect += light;
  else if (isCaustic) pathLight[slot].caustic += light;
  else if ((path.flags & kPathScattered) == 0u) pathLight[slot].emitted += light;
  else pathLight[slot].direct += light;
}

/// A gather ray reads no cell nearer than the root of so many times the cell's area: the path goes on.
const float kNearCells = 4.0;

/// True if light of the path's present history is left to the photon maps.
bool isLeftToMaps(PathState path) {
  return kEyeMode == kEyeImage && (path.flags & kPathScattered) != 0u && (path.flags & kPathSpecular) != 0u;
}

/// True for a rough surface that the maps take for a specular one. The path tracer has no maps.
bool isSpecularForMaps(Bsdf b) { return kEyeMode != kEyePath && isFrosted(b); }

/// True if the camera itself looks at what stands for the environment behind the scene.
bool seesBackground(PathState path) { return kHasBackground && (path.flags & kPathDepthMask) == 0u; }

void addBackground(uint slot, PathState path) {
  pathLight[slot].emitted += path.throughput * params.background;
  pathLight[slot].gathers = kSawBackground;
}

/// Where the path's direction was drawn, which panes have not changed since. `since`: m, from there to the ray.
vec3 lastVertex(Ray ray, float since) { return kHasPanes ? ray.origin - since * ray.direction : ray.origin; }

void addEnvironment(uint slot, PathState path, Ray ray) {
  if (isLeftToMaps(path) || params.environmentLight == kNone) return;
  float weight = 1.0;
  if (path.pdfSolidAngle > 0.0) {
    const vec3 from = lastVertex(ray, path.distance);
    const float chosen = lightProbability(params.lightCount, params.environmentLight, from, path.lightWeight);
    weight = powerHeuristic(path.pdfSolidAngle, chosen * pdfEnvironment(ray.direction));
  }
  addFound(slot, path, environmentRadiance(ray.direction) * weight);
}

/// `since`: as lastVertex.
void addEmission(uint slot, PathState path, Ray ray, Hit hit, Surface s, float since) {
  if ((s.flags & kMaterialUnlit) != 0u) {
    if ((path.flags & kPathScattered) == 0u) addFound(slot, path, s.baseColor);  // seen, but no light source
    return;
  }
  if (!kHasTriangleLights || !s.canEmit || isLeftToMaps(path)) return;
  float weight = 1.0;
  if (path.pdfSolidAngle > 0.0) {
    const uint light = lightOfTriangle(hit.triangle);
    const float cosine = abs(dot(ray.direction, s.geometricNormal));
    const float t = kHasPanes ? since + hit.t : hit.t;
    if (light != kNone)
      weight = powerHeuristic(path.pdfSolidAngle, pdfTriangleLight(params.lightCount, light, lastVertex(ray, since),
                                                                   path.lightWeight, t, cosine));
  }
  addFound(slot, path, s.emission * weight);
}

void writeImporton(uint at, Surface s, Ray ray, PathState path, bool readsGlobal) {
  recordPoints[at] = MapPoint(s.position, packMapPoint(-ray.direction, s.mapNormal, 0u));
  records[at] = Record(vec3(mean(path.throughput)), readsGlobal ? kRecordGlobal : kRecordCaustic);
}

void askForLookup(uint slot, Surface s, Ray ray, Hit hit, inout PathState path, bool readsGlobal, bool isRest,
                  float radius) {
  path.flags |= kPathLookup | (readsGlobal ? kPathLookupGlobal : 0u) | (isRest ? kPathLookupRest : 0u);
  if ((path.flags & kPathScattered) != 0u) path.flags |= kPathLookupDeep;
  lookups[atomicAdd(counters[kCounterLookups], 1u)] = slot;
  eyeVertices[slot] = EyeVertex(s.position, radius, path.throughput, hit.triangle, ray.direction, hit.u, hit.v);
}

/// True if the path, scattered before, may read the global map at s instead of going on. Reads it if it is one of
/// cells, and leaves the other lobes of b, if any, for the path to go on with; else finds the lookup radius.
bool readsGlobalMap(uint slot, inout PathState path, Surface s, Hit hit, Bsdf b, bool knowsImportance,
                    out float radius) {
  radius = 0.0;
  if (kEyeMode == kEyePath || !kHasGlobalMap || (path.flags & kPathScattered) == 0u) return false;
  const bool isLast = (path.flags & kPathDepthMask) >= params.maxDepth;
  if (kReadsCells) {
    if (!hasDiffuse(b)) return false;
    if (kEyeMode == kEyeImage) {
      float area;
      const uint side = cellSide(hit.triangle, vec2(hit.u, hit.v), s.isFront);
      const vec3 irradiance = cellIrradiance(side, area);
      if (path.distance * path.distance < kNearCells * area && !isLast) return false;
      pathLight[slot].indirect += path.throughput * diffuseTowards(b) * irradiance / kPi;
      if (isTranslucent(b))
        pathLight[slot].indirect += path.throughput * diffuseFromBehind(b) * cellIrradiance(side ^ 1u, area) / kPi;
      return true;
    }
  }
  if (!knowsImportance) return true;
  radius = lookupRadius(params.globalMap, lookupDensity(params.globalMap, s.position, s.mapNormal));
  return path.distance > 2.0 * radius || isLast;
}

/// After a cell was read: the path goes on with what it did not hold, by roulette. False: it ends.
bool keepsOtherLobes(inout PathState path, inout Bsdf b, float cosOut, uint id) {
  if (!kHasReflection) return false;
  float left;
  removeDiffuse(b, cosOut, left);
  const float survival = min(left, 1.0);
  if (!(unitFloat(hashCombine(hashCombine(id, params.pass), path.flags & kPathDepthMask)) < survival)) return false;
  path.throughput /= survival;
  return true;
}

/// From off the surface to off the light; `lift` moves the start.
Ray shadowRay(Surface s, LightSample l, vec3 lift, uint id) {
  Ray ray = nextRay(s, l.direction, id);
  ray.origin += lift;
  if (l.distance < kInfinity) {
    const vec3 to = l.target - ray.origin;
    ray.tMax = length(to);
    ray.direction = to / ray.tMax;
  }
  return ray;
}

/// True where smooth normals, not facets, tell what light comes: as the eye sees a surface, directly or in mirrors,
/// and towards a light so low that facets may shadow each other. Elsewhere facets do, as they do for photons.
bool isSmoothlyLit(PathState path, Surface s, float cosGeometric) {
  return (path.flags & kPathScattered) == 0u && s.lift != vec3(0.0) &&
         cosGeometric < 2.0 * distance(s.shadingNormal, s.geometricNormal);
}

/// A shadow ray towards a light, with what it brings if nothing is in the way. [Veach 1997, ch. 9]
void sampleDirectLight(uint slot, inout PathState path, Surface s, Bsdf b, mat3 frame, Ray ray) {
  const uint stream = eyeStream(path.id, path.source), index = eyeIndex(path.id, path.source);
  float probability;
  vec2 u = sequencePoint(stream, index, eventPair(path.flags, kPairLight));
  const uint light = chooseLight(params.lightCount, s.position, u.x, probability, path.lightWeight);
  if (light == kNone) return;
  const LightSample l = sampleLight(light, probability, s.position, min(u, vec2(0.99999994)));
  const float cosGeometric = dot(l.direction, s.geometricNormal);
  const vec3 wi = l.direction * frame;
  const bool isOneSided = (cosGeometric <= 0.0) == (wi.z <= 0.0);  // of both normals; else no scattering finds it
  const bool isLifted = wi.z > 0.0 && isSmoothlyLit(path, s, cosGeometric);
  if (!isOneSided && !isLifted) return;
  float pdfScatter;
  const vec3 f = evalBsdf(b, -ray.direction * frame, wi, pdfScatter);
  const float weight = l.pdf > 0.0 && isOneSided ? powerHeuristic(l.pdf, pdfScatter) : 1.0;
  const bool isRefracted = kHasTransmission && wi.z < 0.0 && !b.isThin;
  const vec3 light3 = path.throughput * f * l.radiance * (isRefracted ? weight / (b.eta * b.eta) : weight);
  if (maxComponent(light3) <= 0.0) return;
  shadowRays[slot] = shadowRay(s, l, isLifted ? s.lift : vec3(0.0), ray.id);
  shadowLight[slot] = light3;
  if ((path.flags & kPathScattered) != 0u) path.flags |= kPathShadowDeep;
  if (atomicAdd(counters[kSumRaysShadow], 1u) == 0xFFFFFFFFu) atomicAdd(counters[kSumRaysShadow + 1u], 1u);
}

/// Notes a place of which pixels may share light: the glass that the camera sees, where paths part by chance, else
/// where the path gathers.
void noteShared(uint slot, Surface s) {
  pathLight[slot].sharedPosition = s.position;
  pathLight[slot].sharedNormal = s.geometricNormal;
}

/// Notes where the path gathers light, and by what the surface there scales it: about its albedo, whichever lobe is
/// sampled and whether or not the direction leaves the surface, so that pixels can share what is left.
void beginGather(uint slot, PathState path, Surface s, Bsdf b) {
  pathLight[slot].modulation = path.throughput * (b.diffuse + b.below + b.f0 + b.clear * b.tint);
  pathLight[slot].position = s.position;
  pathLight[slot].normal = s.shadingNormal;
  pathLight[slot].gathers = 1u;
  if (pathLight[slot].sharedNormal == vec3(0.0)) noteShared(slot, s);
}

/// Samples the next direction. After a global lookup only a specular event goes on. False: the path ends.
/// `lightWeight`: what the path had before light was sampled here.
bool scatterEye(uint slot, inout PathState path, Surface s, Bsdf b, mat3 frame, Ray ray, bool hasRead,
                float lightWeight, out Ray next) {
  const vec2 choice = eyePoint(path, kPairLobe);
  const BsdfSample sampled = sampleBsdf(b, -ray.direction * frame, choice.x, eyePoint(path, kPairScatter));
  const vec3 wi = frame * sampled.wi;
  next = nextRay(s, wi, hash(ray.id + 1u));
  if (hasRead && !sampled.isDelta) return false;
  const bool isSpecular = sampled.isDelta || isSpecularForMaps(b);
  const bool beginsGather = kEyeMode != kEyeImportons && !isSpecular && (path.flags & kPathScattered) == 0u;
  if (beginsGather) beginGather(slot, path, s, b);
  if (!isConsistent(s, wi, sampled.isTransmission)) return false;
  vec3 weight = sampled.weight;
  // Radiance is scaled by the squared relative index where light is refracted. [Veach 1997, eq. 5.2]
  if (kHasTransmission && sampled.isTransmission && !b.isThin) weight /= b.eta * b.eta;
  path.throughput *= weight;
  const float depth = float(path.flags & kPathDepthMask);
  if (depth >= 3.0) {
    const float survival =
        min(0.95, maxComponent(path.throughput) / (kEyeMode == kEyeImportons ? params.importonFlux : 1.0));
    if (!(choice.y < survival)) return false;
    path.throughput /= survival;
  }
  if (passesPane(s, sampled)) {
    path.lightWeight = lightWeight;
  } else if (isSpecular) {
    path.flags |= kPathSpecular;
    path.pdfSolidAngle = (path.flags & kPathScattered) == 0u ? sampled.pdf : 0.0;
    if ((path.flags & kPathScattered) == 0u) path.distance = 0.0;
  } else {
    if ((path.flags & kPathScattered) != 0u) path.flags |= kPathDeep;
    path.flags = (path.flags & ~kPathSpecular) | kPathScattered;
    path.pdfSolidAngle = sampled.pdf;
    path.distance = 0.0;
  }
  path.flags += 1u;
  if (updateMedia(path, s, sampled.isTransmission)) atomicAdd(counters[kCounterMediaForgotten], 1u);
  return (path.flags & kPathDepthMask) <= params.maxDepth && maxComponent(path.throughput) > 0.0;
}

#endif
