/// KHR_techniques_webgl, whose materials are programs, in terms of our material.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "scene/container/faults.h"

namespace importon {

/// Rewrites each material that has the extension and no metallic-roughness material beside it: a matte one whose base
/// colour is the colour or texture among its values that is called diffuse, white without. One small fault each. The
/// document has passed checkSchema.
void convertTechniques(nlohmann::json& document, const Faults& faults);

}  // namespace importon
