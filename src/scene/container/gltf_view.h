/// The bytes of buffer views.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "scene/container/gltf_document.h"

namespace importon {

/// The byteLength bytes of a view, decoded when they are first asked for where they are compressed. Valid as long as
/// the document. Not for several threads at once. Throws SceneError.
[[nodiscard]] std::span<const unsigned char> viewBytes(const GltfDocument& document, std::size_t view);

/// A new view, which has a buffer to itself. Its index.
int addView(GltfDocument& document, std::vector<unsigned char> bytes);

}  // namespace importon
