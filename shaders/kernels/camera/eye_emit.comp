#version 460
// Paths leave the camera: some per pixel of a tile, or importons all over the film. The paths of a pixel are the same
// whichever part of the image the film is.
#extension GL_GOOGLE_include_directive : require
#include "bindings/paths.glsl"
#include "bindings/film.glsl"
#include "lib/features.glsl"
#include "lib/camera.glsl"
#include "lib/eye_stream.glsl"
#include "lib/pixel_filter.glsl"

layout(constant_id = kSpecPixelFilter) const uint kPixelFilter = kFilterBox;

layout(push_constant, scalar) uniform Push {
  uint first;     // pixel of the film, or importon
  uint count;
  uint pixels;    // of the tile, or importons
  uint firstSample;  // of each pixel's paths in this pass, or of the plan's paths
  uint total;     // importons in all
  uint isCentred; // 1: through the middles of the pixel and of the lens
  uint isPlanned; // 1: pixels have as many paths as the sample plan says
} push;

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  // All pixels of the tile, then all again for the next path of each; or the paths of each as planned.
  uint pixel = slot % push.pixels, sampleOfPixel = push.firstSample + slot / push.pixels;
  if (push.isPlanned != 0u) {
    const uint path = push.firstSample + slot;
    pixel = plannedPixel(path, push.pixels);
    const uvec2 planned = plannedPaths(pixel);
    sampleOfPixel = planned.y + path - planned.x;
  }
  const bool isImporton = kEyeMode == kEyeImportons;
  const uvec2 place = imagePixel(push.first + pixel);
  const uint id = isImporton ? push.first + pixel : imageIndex(place);
  const uint index = eyeIndex(id, sampleOfPixel);
  const vec2 u = sequencePoint(eyeStream(id, sampleOfPixel), index, kPairFirst);
  const vec2 size = vec2(params.width, params.height);
  const vec2 position = isImporton ? vec2(params.filmCorner) + u * size
                                   : vec2(place) + (push.isCentred != 0u ? vec2(0.5) : pixelPoint(kPixelFilter, u));
  Ray ray = cameraRay(params, position);
  if (hasLens(params) && push.isCentred == 0u)
    throughLens(params, sequencePoint(eyeStream(id, sampleOfPixel), index, kPairLens), ray);
  ray.id = hash(eyeStream(id, sampleOfPixel) ^ hash(index));

  PathState path;
  // Importons: the film emits as many units as it has pixels.
  path.throughput = vec3(isImporton ? size.x * size.y / float(push.total) : 1.0);
  path.flags = 0u;
  path.id = id;
  path.media = uvec2(0u);
  path.pdfSolidAngle = 0.0;
  path.lightWeight = 0.0;
  path.source = sampleOfPixel;
  path.distance = 0.0;
  rays[slot] = ray;
  paths[slot] = path;
  queue[slot] = slot;
  if (isImporton) return;
  const vec3 none = vec3(0.0);
  pathLight[slot] = PathLight(none, none, none, none, none, none, none, none, none, 0u);
}
