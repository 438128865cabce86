// The emission guide at work.
#ifndef IMPORTON_BINDINGS_GUIDE_GLSL
#define IMPORTON_BINDINGS_GUIDE_GLSL
#include "bindings/parameters.glsl"

uniform samplerBuffer guideRows;
uniform samplerBuffer guideColumns;

float guideRow(uint i) { return texelFetch(guideRows, int(i)).x; }
float guideColumn(uint i) { return texelFetch(guideColumns, int(i)).x; }

#include "lib/guide.glsl"

#endif
