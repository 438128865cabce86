// The records of the map at work: indices into the records, and what is known of each.
#ifndef IMPORTON_BINDINGS_SELECTION_GLSL
#define IMPORTON_BINDINGS_SELECTION_GLSL
#include "bindings/records.glsl"

layout(scalar) readonly buffer SelectionBlock { uint selection[]; };
layout(scalar) buffer RequiredBlock { float required[]; };
layout(scalar) buffer SelectedPointsBlock { MapPoint selectedPoints[]; };
layout(scalar) buffer KeepBlock { uint keep[]; };

#endif
