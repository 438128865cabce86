// The tree of lights, and what lib/light_tree.glsl asks for besides.
#ifndef IMPORTON_BINDINGS_LIGHT_TREE_GLSL
#define IMPORTON_BINDINGS_LIGHT_TREE_GLSL
#include "bindings/parameters.glsl"
#include "bindings/tables.glsl"

/// What lights are worth that no photon has come from to the surroundings: not yet found or, the more photons have been
/// shot the surer, hidden.
float unseenLight() { return max(0.05 / float(1u + params.pass), 0.01); }

#include "lib/light_tree.glsl"

#endif
