// Lets one header be read by C++ and by GLSL: GLSL vector types become GLM's.
// All buffers use layout(scalar), and structs hold 4-byte members only, so both sides agree;
// what is written for each kernel when building (src/gpu/modules/describe_kernels.cpp) does not compile otherwise.
#ifndef IMPORTON_SHARED_GLSL_COMPAT_H
#define IMPORTON_SHARED_GLSL_COMPAT_H
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace importon {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
using mat4 = glm::mat4;
}  // namespace importon
#define SHARED_BEGIN namespace importon {
#define SHARED_END }
#define SHARED_CONST inline constexpr
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_CONST const
#endif
#endif
