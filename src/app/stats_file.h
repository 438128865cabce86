/// The JSON that `--stats` writes.
#pragma once
#include <span>
#include <string>

#include "base/log.h"
#include "render/render_job.h"
#include "render/render_stats.h"

namespace importon {

/// The statistics of a render as JSON text, with the names of the command line contract. What is not finite
/// becomes null.
[[nodiscard]] std::string statsJson(const RenderJob& job, const RenderStats& stats, std::span<const Warning> warnings);

}  // namespace importon
