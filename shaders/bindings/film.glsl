// What paths brought to their pixels in this pass.
#ifndef IMPORTON_BINDINGS_FILM_GLSL
#define IMPORTON_BINDINGS_FILM_GLSL
#include "bindings/parameters.glsl"

layout(scalar, binding = kBindingPathLight) buffer PathLightBlock { PathLight pathLight[]; };

#endif
