/// What a file offers to choose from: scenes, and variants of materials.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/container/file_choices.h"

namespace importon {

/// Makes the choice the document's own: its "scene" becomes the one that is chosen, and primitives get the materials of
/// the chosen variant (KHR_materials_variants). A variant that a primitive does not map leaves its material. The
/// document has passed checkSchema. Throws UsageError, with the names that there are, where a choice names none of
/// them.
void applyChoices(nlohmann::json& document, const FileChoices& choices);

/// The animation that `name` means, by name or index; none where it is empty: all of them. Throws UsageError as above.
[[nodiscard]] std::optional<std::size_t> chooseAnimation(const nlohmann::json& document, const std::string& name);

/// The names of all scenes and variants, in the order of the file; "" for one without.
[[nodiscard]] std::vector<std::string> sceneNames(const nlohmann::json& document);
[[nodiscard]] std::vector<std::string> variantNames(const nlohmann::json& document);

}  // namespace importon
