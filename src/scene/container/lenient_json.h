/// JSON as people write it: with comments, and with commas after the last element.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "scene/container/faults.h"
#include "scene/container/gltf_source.h"

namespace importon {

/// Parses RFC 8259; a byte of 0 ends the text. Where that fails, comments, and commas before a closing bracket, are
/// small faults. Throws SceneError, also where brackets are nested deeper than 64 levels; NaN and Infinity, which JSON
/// does not have, are named.
[[nodiscard]] nlohmann::json parseLenient(std::string_view text, const GltfSource& source, const Faults& faults);

}  // namespace importon
