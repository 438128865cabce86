/// Files for tests that damage files.
#pragma once
#include "loader/gltf_builder.h"

namespace importon::test {

/// A small file that uses as much of the format as it can.
[[nodiscard]] GltfBuilder everything();

/// A small file lit by a lamp of measured intensity (EXT_lights_ies).
[[nodiscard]] GltfBuilder profileFile();

}  // namespace importon::test
