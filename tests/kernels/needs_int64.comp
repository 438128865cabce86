// Uses a feature that the device was not asked for; validation must say so.
#version 460
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;

layout(set = 0, binding = 1, scalar) buffer Out { uint result; };

void main() { result = uint((uint64_t(result) * 3ul) >> 1); }
