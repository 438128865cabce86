/// The animations of a file.
#pragma once
#include <vector>

#include "base/log.h"
#include "scene/animation/animation_summary.h"
#include "scene/container/gltf_document.h"

namespace importon {

/// Sets all that animations move to what it is at `choices.at` seconds, as if the file said so: all animations, or the
/// one that `choices.animation` names. Nothing where no time is chosen. Channels that move nothing which is known are
/// passed over with a warning. Throws SceneError where data are missing or do not fit, and UsageError where there is no
/// animation of that name.
void poseDocument(GltfDocument& document, const FileChoices& choices, Log& log);

/// Of all animations, as they stand in the file. What is broken is a warning.
[[nodiscard]] std::vector<AnimationSummary> describeAnimations(GltfDocument& document, Log& log);

}  // namespace importon
