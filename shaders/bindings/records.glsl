// Records of hits or importons as they come.
#ifndef IMPORTON_BINDINGS_RECORDS_GLSL
#define IMPORTON_BINDINGS_RECORDS_GLSL
#include "bindings/parameters.glsl"

layout(scalar) buffer RecordPointsBlock { MapPoint recordPoints[]; };
layout(scalar) buffer RecordsBlock { Record records[]; };

#endif
