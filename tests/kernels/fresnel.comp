// Reflectance of smooth interfaces.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lib/dispatch.glsl"
#include "lib/fresnel.glsl"

struct Incidence {
  float cosine, eta, f0, f90;
};
struct Reflectances {
  float dielectric, schlick;
};

layout(binding = 0, scalar) readonly buffer In { Incidence items[]; };
layout(binding = 1, scalar) writeonly buffer Out { Reflectances results[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  const uint i = invocationIndex();
  if (i >= count) return;
  const Incidence q = items[i];
  results[i] = Reflectances(fresnelDielectric(q.cosine, q.eta), fresnelSchlick(vec3(q.f0), q.f90, q.cosine).x);
}
