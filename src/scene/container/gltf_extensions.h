/// Which glTF extensions the loader knows.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "base/log.h"
#include "scene/container/gltf_source.h"

namespace importon {

/// Throws SceneError on an unknown name in extensionsRequired; names all unknown ones in extensionsUsed in one
/// warning. The document has passed checkSchema.
void checkExtensions(const nlohmann::json& document, const GltfSource& source, Log& log);

}  // namespace importon
