/// The keys of an animation as a file has them.
#pragma once
#include <string>
#include <vector>

#include "scene/animation/animated_value.h"
#include "scene/animation/key_track.h"
#include "scene/container/gltf_document.h"

namespace importon {

/// The times of a sampler's keys in s; empty: it has none. `pointer` is the sampler's. Throws SceneError unless they
/// are floats, finite, not negative and rising; of keys at one time, a small fault, the last is meant.
[[nodiscard]] std::vector<float> readKeyTimes(const GltfDocument& document, const nlohmann::json& sampler,
                                              const std::string& pointer);

/// The keys of a sampler for a value; without times: it has none. Throws SceneError, also where the numbers are not
/// finite or not as many as the keys need.
[[nodiscard]] KeyTrack readKeyTrack(const GltfDocument& document, const nlohmann::json& sampler,
                                    const std::string& pointer, const AnimatedValue& value);

}  // namespace importon
