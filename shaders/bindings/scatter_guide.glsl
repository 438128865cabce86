// The guide for scattering at work.
#ifndef IMPORTON_BINDINGS_SCATTER_GUIDE_GLSL
#define IMPORTON_BINDINGS_SCATTER_GUIDE_GLSL
#include "bindings/parameters.glsl"

uniform samplerBuffer scatterGuidesWords;

float scatterGuide(uint i) { return texelFetch(scatterGuidesWords, int(i)).x; }

#include "lib/scatter_guide.glsl"

#endif
