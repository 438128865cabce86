/// Files for tests that damage files.
#pragma once
#include "loader/gltf_builder.h"

namespace importon::test {

/// A small file that uses as much of the format as it can.
[[nodiscard]] GltfBuilder everything();

/// A small file lit by a lamp of measured intensity (EXT_lights_ies).
[[nodiscard]] GltfBuilder profileFile();

/// The first with an animation of all that a node has, and of a material: all kinds of interpolation, 2 s long.
[[nodiscard]] GltfBuilder animatedFile();

}  // namespace importon::test
