#version 460
// Adds what the paths of a pass brought to the half of the film that the pass belongs to.
#extension GL_GOOGLE_include_directive : require
#include "bindings/film.glsl"
#include "lib/long_sum.glsl"

layout(scalar, binding = kBindingFilm) buffer FilmBlock { FilmPixel film[]; };
layout(push_constant, scalar) uniform PushBlock { FilmAddPush push; };

FilmPixel pixel;
uint random;
bool isLong;

void add(inout vec3 sum, vec3 value) {
  if (!isLong) {
    sum += value;
    return;
  }
  random = hash(random + 3u);
  sum = addRandomly(sum, value, random);
}

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  isLong = params.pass >= kNearestAdditions / params.samplesPerPass;
  pixel = film[push.offset + slot];
  for (uint k = 0u; k < push.samples; ++k) {
    const PathLight light = pathLight[k * push.count + slot];
    random = hashCombine(hashCombine(params.pass, push.first + k), slot);
    add(pixel.direct, light.direct);
    add(pixel.caustic, light.caustic);
    add(pixel.indirect, light.indirect);
    add(pixel.modulation, light.modulation);
    add(pixel.position, light.position);
    add(pixel.normal, light.normal);
    const vec3 sum = light.direct + light.caustic + light.indirect;
    add(pixel.square, sum * sum);
    vec3 gathers = vec3(pixel.gathers, 0.0, 0.0);
    add(gathers, vec3(float(light.gathers), 0.0, 0.0));
    pixel.gathers = gathers.x;
  }
  film[push.offset + slot] = pixel;
}
