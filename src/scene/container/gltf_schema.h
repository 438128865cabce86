/// Checks the JSON of a glTF file before anything is read from it: types, ranges, and every index.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "scene/container/faults.h"
#include "scene/container/gltf_schema_rules.h"
#include "scene/container/gltf_source.h"

namespace importon {

/// Throws SceneError, with the JSON pointer of the culprit, unless each property that the loader reads has the
/// type and range that glTF 2.0 asks for and each index names an existing element. What comes after may index
/// without asking. (tinygltf 2.7 reads a property of the wrong type as if it weren't there, and checks hardly
/// any index.)
/// Small faults are mended in place: members that are null go, numbers off their range are clamped where a rule says
/// so, whole numbers that are written 1.0 become 1.
void checkSchema(nlohmann::json& document, const GltfSource& source, const Faults& faults);

/// The same by these rules alone.
void checkSchema(nlohmann::json& document, const GltfSource& source, const Faults& faults,
                 const std::vector<SchemaRule>& rules);

}  // namespace importon
