/// KHR_draco_mesh_compression, by libdraco.
#pragma once
#include "base/log.h"
#include "scene/container/gltf_document.h"

namespace importon {

/// Decodes the compressed primitives: gives them accessors of their own, over buffers that hold what was decoded as the
/// file's accessors describe it. Where it cannot be decoded, or does not fit its accessors, the primitive stays as it
/// is, with a warning, if its accessors have data of their own. Throws SceneError otherwise.
void decodeDracoMeshes(GltfDocument& document, Log& log);

}  // namespace importon
