/// Bounds-checked reading of accessors: component types, normalised integers, strides, sparse values.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/container/gltf_document.h"

namespace importon {

/// All elements as floats. Normalised integers become [0, 1] or [-1, 1]; others their value. Throws SceneError
/// at `pointer` (where the accessor is used) unless it has `N` components of a type that glTF allows and lies
/// in its buffer view. VEC4 from a VEC3 accessor is allowed and fills with 1 (COLOR_0). One implementation for
/// N = 1 (a SCALAR), 2, 3, 4.
template <int N>
[[nodiscard]] std::vector<glm::vec<N, float>> readFloats(const GltfDocument& document, int accessor,
                                                         const std::string& pointer);

/// The elements of a SCALAR accessor of unsigned integers. Throws SceneError at `pointer`.
[[nodiscard]] std::vector<std::uint32_t> readIndices(const GltfDocument& document, int accessor,
                                                     const std::string& pointer);

/// The elements of a MAT4 accessor of floats. Throws SceneError at `pointer`.
[[nodiscard]] std::vector<glm::mat4> readMatrices(const GltfDocument& document, int accessor,
                                                  const std::string& pointer);

}  // namespace importon
