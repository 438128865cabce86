#version 460
// A path from the camera meets a surface. Light emitted there is added; at a surface that is not purely specular
// direct light is sampled and a map lookup asked for; then the path goes on: by a specular event, by a gather
// ray, or beyond a gather segment that is too short for the global map. Importons do the same and leave a record
// wherever the image would read a map.
#extension GL_GOOGLE_include_directive : require
#include "bindings/lights.glsl"
#include "bindings/paths.glsl"
#include "bindings/film.glsl"
#include "bindings/records.glsl"
#include "bindings/importance.glsl"
#include "bindings/eye.glsl"

layout(push_constant, scalar) uniform Push {
  uint source;
  uint knowsImportance;
} push;

void main() {
  const uint i = invocationIndex();
  if (i >= counters[push.source]) return;
  const uint slot = queue[i];
  const Ray ray = rayAt(slot);
  const Hit hit = hitAt(slot);
  PathState path = paths[slot];
  keep[i] = 0u;
  path.flags &= ~(kPathLookup | kPathLookupGlobal | kPathLookupDeep | kPathLookupRest | kPathShadowDeep);
  if (kEyeMode == kEyeImportons) records[counters[kCounterRecords] + i].kind = kRecordNone;
  else shadowRays[slot].tMax = 0.0;
  paths[slot].flags = path.flags;
  if (hit.triangle == kNone) {
    if (kEyeMode == kEyeImportons) return;
    if (seesBackground(path)) addBackground(slot, path);
    else if (kHasEnvironment) addEnvironment(slot, path, ray);
    return;
  }

  Surface s = loadSurface(hit.triangle, vec2(hit.u, hit.v), ray.direction);
  chooseChannel(s, path, ray.id, params.pass);
  relateIndex(s, path);
  if (kHasMedia) path.throughput *= mediumTransmittance(path.media, s, hit.t);
  const float since = path.distance, lightWeight = path.lightWeight;
  path.distance += hit.t;
  if (kEyeMode != kEyeImportons) addEmission(slot, path, ray, hit, s, since);
  if ((s.flags & kMaterialUnlit) != 0u) return;

  if (kHasTransmission && kEyeMode != kEyeImportons && (path.flags & kPathDepthMask) == 0u && s.transmission > 0.0)
    noteShared(slot, s);

  const float cosOut = dot(-ray.direction, s.shadingNormal);
  Bsdf b = makeBsdf(s, cosOut);
  const mat3 frame = frameAround(s.shadingNormal);
  const bool isSpecular = isSpecularForMaps(b);
  const bool isRough = hasRoughLobe(b) && !isSpecular;
  float radius;
  const bool reads = isRough && readsGlobalMap(slot, path, s, hit, b, push.knowsImportance != 0u, radius);
  if (isRough && kEyeMode == kEyeImportons) writeImporton(counters[kCounterRecords] + i, s, ray, path, reads);
  // What a cell does not hold goes on as if nothing had been read.
  bool isRest = false;
  if (reads && kReadsCells) {
    isRest = keepsOtherLobes(path, b, cosOut, ray.id);
    if (!isRest) return;
  }
  const bool hasRead = reads && !kReadsCells;
  bool takesLight = isSpecular && kEyeMode == kEyeImage && (path.flags & kPathScattered) == 0u;
  if (isRough && kEyeMode != kEyeImportons && (!isRest || hasRoughLobe(b))) {
    if (hasRead || (kHasCausticMap && kEyeMode == kEyeImage))
      askForLookup(slot, s, ray, hit, path, hasRead, isRest, radius);
    // At its last vertex a path in the path tracer takes no more light: that would be an event too many.
    const bool isLast = kEyeMode == kEyePath && (path.flags & kPathDepthMask) >= params.maxDepth;
    takesLight = !hasRead && !isLast;
  }
  if (takesLight) sampleDirectLight(slot, path, s, b, frame, ray);
  Ray next;
  const bool goesOn = scatterEye(slot, path, s, b, frame, ray, hasRead, lightWeight, next);
  paths[slot] = path;
  if (!goesOn) return;
  keep[i] = 1u;
  rays[slot] = next;
}
