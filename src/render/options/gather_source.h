/// What gather rays read: surface cells, or the photons of a classical photon map.
#pragma once
#include <string>
#include <string_view>

#include "render/render_job.h"

namespace importon {

/// The first option of `job` that only makes sense where gather rays read photons, as it is written on the command
/// line; empty if there is none.
[[nodiscard]] std::string photonReason(const RenderJob& job);

/// What gather rays of `job` read: photons if the job says so, or if an option is about them; else cells.
[[nodiscard]] GatherSource gatherSource(const RenderJob& job);

/// "cells" or "photons", as --gather-from and the statistics have it; "none" for the path tracer, which reads no map.
[[nodiscard]] std::string_view gatherSourceName(const RenderJob& job);

}  // namespace importon
