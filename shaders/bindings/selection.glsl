// The records of the map at work: indices into the records, and what is known of each.
#ifndef IMPORTON_BINDINGS_SELECTION_GLSL
#define IMPORTON_BINDINGS_SELECTION_GLSL
#include "bindings/records.glsl"

layout(scalar, binding = kBindingSelection) readonly buffer SelectionBlock { uint selection[]; };
layout(scalar, binding = kBindingRequired) buffer RequiredBlock { float required[]; };
layout(scalar, binding = kBindingSelectedPoints) buffer SelectedPointsBlock { MapPoint selectedPoints[]; };
layout(scalar, binding = kBindingKeep) buffer KeepBlock { uint keep[]; };

#endif
