// The emission guide at work.
#ifndef IMPORTON_BINDINGS_GUIDE_GLSL
#define IMPORTON_BINDINGS_GUIDE_GLSL
#include "bindings/parameters.glsl"

uniform samplerBuffer guideRowsWords;
uniform samplerBuffer guideColumnsWords;

float guideRow(uint i) { return texelFetch(guideRowsWords, int(i)).x; }
float guideColumn(uint i) { return texelFetch(guideColumnsWords, int(i)).x; }

#include "lib/guide.glsl"

#endif
