#version 460
// Adds what the paths of a pass brought to the half of the film that the pass belongs to.
#extension GL_GOOGLE_include_directive : require
#include "bindings/film.glsl"

layout(scalar, binding = kBindingFilm) buffer FilmBlock { FilmPixel film[]; };
layout(push_constant, scalar) uniform PushBlock { FilmAddPush push; };

void main() {
  const uint slot = invocationIndex();
  if (slot >= push.count) return;
  FilmPixel pixel = film[push.offset + slot];
  for (uint k = 0u; k < push.samples; ++k) {
    const PathLight light = pathLight[k * push.count + slot];
    pixel.direct += light.direct;
    pixel.caustic += light.caustic;
    pixel.indirect += light.indirect;
    pixel.modulation += light.modulation;
    pixel.position += light.position;
    pixel.normal += light.normal;
    pixel.gathers += float(light.gathers);
    const vec3 sum = light.direct + light.caustic + light.indirect;
    pixel.square += sum * sum;
  }
  film[push.offset + slot] = pixel;
}
