/// Triangle lists from triangles, strips and fans.
#pragma once
#include <cstddef>
#include <vector>

#include "shared/scene_data.h"

namespace importon {

/// Primitive modes of glTF that hold triangles.
enum class TriangleMode { triangles = 4, strip = 5, fan = 6 };

/// The triangles of glTF 2.0, section 3.7.2.1; winding as there. Those of strips and fans that repeat an index
/// (the stitches between joined strips) are left out; incomplete triangles at the end too.
[[nodiscard]] std::vector<uvec3> triangulate(TriangleMode mode, const std::vector<uint>& indices);

/// The same for vertices 0 to count - 1 in this order.
[[nodiscard]] std::vector<uvec3> triangulate(TriangleMode mode, std::size_t count);

}  // namespace importon
