// Random streams of eye paths: each pixel has a sequence through all passes; importons have one together.
#ifndef IMPORTON_LIB_EYE_STREAM_GLSL
#define IMPORTON_LIB_EYE_STREAM_GLSL
#include "lib/features.glsl"
#include "lib/path_pairs.glsl"

uint eyeStream(uint id) {
  if (kEyeMode == kEyeImportons) return hashCombine(params.seed, kStreamImportons);
  return hashCombine(hashCombine(params.seed, kStreamPixels), id);
}

uint eyeIndex(uint id, uint sampleOfPixel) {
  return kEyeMode == kEyeImportons ? id : params.pass * params.samplesPerPass + sampleOfPixel;
}

/// The point of the path's sequence for a decision (kPair*) of the event at hand.
vec2 eyePoint(PathState path, uint pair) {
  return sequencePoint(eyeStream(path.id), eyeIndex(path.id, path.source), eventPair(path.flags, pair));
}

#endif
