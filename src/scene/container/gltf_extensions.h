/// Which glTF extensions the loader knows.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "base/log.h"
#include "scene/container/faults.h"

namespace importon {

/// Throws SceneError on a name in extensionsRequired without which the picture would be wrong or the file unreadable;
/// one that does not alter the picture is a small fault. Names all in extensionsUsed that the picture lacks in one
/// warning. The document has passed checkSchema.
void checkExtensions(const nlohmann::json& document, const GltfSource& source, const Faults& faults, Log& log);

}  // namespace importon
