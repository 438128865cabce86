// Random streams of eye paths: each pixel has a sequence through all passes; importons have one together.
#ifndef IMPORTON_LIB_EYE_STREAM_GLSL
#define IMPORTON_LIB_EYE_STREAM_GLSL
#include "lib/features.glsl"
#include "lib/path_pairs.glsl"

uvec2 eyeNumber(uint id, uint sampleOfPixel) {
  return kEyeMode == kEyeImportons ? uvec2(id, 0u) : longIndex(params.firstSample, sampleOfPixel);
}

uint eyeStream(uint id, uint sampleOfPixel) {
  if (kEyeMode == kEyeImportons) return hashCombine(params.seed, kStreamImportons);
  return streamFor(hashCombine(hashCombine(params.seed, kStreamPixels), id), eyeNumber(id, sampleOfPixel));
}

uint eyeIndex(uint id, uint sampleOfPixel) { return eyeNumber(id, sampleOfPixel).x; }

/// The point of the path's sequence for a decision (kPair*) of the event at hand.
vec2 eyePoint(PathState path, uint pair) {
  return sequencePoint(eyeStream(path.id, path.source), eyeIndex(path.id, path.source), eventPair(path.flags, pair));
}

#endif
