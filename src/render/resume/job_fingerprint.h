/// Tells whether two runs make the same image.
#pragma once
#include <cstdint>

#include "render/render_job.h"
#include "scene/scene.h"

namespace importon {

/// A hash of all that decides the image but seed, number of passes and device: the scene with its camera, the
/// size, and the settings of the method. Images of equal fingerprints may be averaged (report/merge.h).
[[nodiscard]] std::uint64_t imageFingerprint(const RenderJob& job, const Scene& scene);

}  // namespace importon
