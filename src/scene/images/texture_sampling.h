/// Texture lookups on the host, for means over triangles.
#pragma once
#include <span>

#include "shared/scene_data.h"

namespace importon {

/// Where a texture is read for coordinates of its UV set: after its transform, not yet wrapped.
[[nodiscard]] vec2 transformUv(const Texture& texture, const vec2& uv);

/// The linear RGB of the texel that holds `uv`, which transformUv gave.
[[nodiscard]] vec3 nearestTexel(const Texture& texture, std::span<const uint> texels, const vec2& uv);

/// The mean linear RGB over the triangle with corners `uv` (of its UV set), from a grid of samples about as
/// fine as the texels and at most 64 a side.
[[nodiscard]] vec3 meanOverTriangle(const Texture& texture, std::span<const uint> texels, const vec2 (&uv)[3]);

}  // namespace importon
