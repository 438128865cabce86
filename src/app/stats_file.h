/// The JSON that `--stats` writes.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "base/log.h"
#include "render/render_job.h"
#include "render/render_stats.h"

namespace importon {

/// The statistics of a render as JSON text, with the names of the command line contract. What is not finite
/// becomes null.
[[nodiscard]] std::string statsJson(const RenderJob& job, const RenderStats& stats, std::span<const Warning> warnings);

/// The same as a value, without the version and the command.
[[nodiscard]] nlohmann::ordered_json statsTree(const RenderJob& job, const RenderStats& stats,
                                               std::span<const Warning> warnings);

/// As text for a file. A file name need not be UTF-8, JSON must be: what is not is replaced.
[[nodiscard]] std::string jsonText(const nlohmann::ordered_json& json);

}  // namespace importon
