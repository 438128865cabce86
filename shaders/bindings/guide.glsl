// The emission guide at work.
#ifndef IMPORTON_BINDINGS_GUIDE_GLSL
#define IMPORTON_BINDINGS_GUIDE_GLSL
#include "bindings/parameters.glsl"

layout(binding = kBindingGuideRows) uniform samplerBuffer guideRows;
layout(binding = kBindingGuideColumns) uniform samplerBuffer guideColumns;

float guideRow(uint i) { return texelFetch(guideRows, int(i)).x; }
float guideColumn(uint i) { return texelFetch(guideColumns, int(i)).x; }

#include "lib/guide.glsl"

#endif
