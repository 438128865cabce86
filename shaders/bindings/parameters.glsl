// Parameters and counters: what nearly every kernel reads.
#ifndef IMPORTON_BINDINGS_PARAMETERS_GLSL
#define IMPORTON_BINDINGS_PARAMETERS_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "shared/ray_data.h"
#include "shared/render_data.h"
#include "shared/scene_data.h"
#include "lib/dispatch.glsl"

const float kInfinity = 1.0 / 0.0;

layout(scalar) uniform ParametersBlock { Parameters params; };
layout(scalar) buffer CountersBlock { uint counters[]; };

#endif
