#version 460
// Light on the groups of a level, and the share of what their members differ by that is more than noise, which is the
// Poisson noise of the group's photons. [James and Stein 1961; Efron and Morris 1973]
#extension GL_GOOGLE_include_directive : require
#include "bindings/cell_groups.glsl"

layout(scalar) writeonly buffer GroupLightBlock { uvec4 groupOut[]; };
layout(push_constant, scalar) uniform Push {
  uint first;  // group of the level
  uint count;
  uint cells;
} push;

CellLight lightOfMember(uint member, uint side) {
  const uint node = texelFetch(cellMembersWords, int(member)).x;
  if (node < push.cells) return lightOfCell(node, side);
  float share;
  uint outer;
  return lightOfGroup(node - push.cells, side, share, outer);
}

void main() {
  const uint i = invocationIndex();
  if (i >= 2u * push.count) return;
  const uint group = push.first + i / 2u, side = i % 2u;
  const uvec4 place = texelFetch(cellGroupsTexels, int(group));
  const float area = max(uintBitsToFloat(place.w), 1e-30);
  vec3 flux = vec3(0.0);
  float squares = 0.0;
  for (uint k = place.x; k < place.y; ++k) {
    const CellLight light = lightOfMember(k, side);
    flux += light.irradiance * light.area;
    squares += light.squares;
  }
  const vec3 mean = flux / area;
  float differences = 0.0;  // area-weighted squares of them
  for (uint k = place.x; k < place.y && squares > 0.0; ++k) {
    const CellLight light = lightOfMember(k, side);
    const vec3 difference = light.irradiance - mean;
    differences += light.area * dot(difference, difference);
  }
  const float noise = max(float(place.y - place.x) - 3.0, 0.0) * squares / area;
  const float share = differences > noise ? 1.0 - noise / differences : 0.0;
  const uint at = 2u * (2u * group + side);
  groupOut[at] = uvec4(floatBitsToUint(mean), floatBitsToUint(share));
  groupOut[at + 1u] = uvec4(floatBitsToUint(squares), place.w, place.z, 0u);
}
