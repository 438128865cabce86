/// Options of `importon render` that follow the talk and its author's program, and --talk, which sets them all.
#pragma once
#include "CLI/CLI.hpp"
#include "render/render_job.h"

namespace importon {

/// The heading of these options in the help.
inline constexpr const char* kTalkGroup = "As in the talk";

/// Declares the options on `app`; parsing writes to `job` and `isTalk`.
void addTalkOptions(CLI::App& app, RenderJob& job, bool& isTalk);

/// The settings of the talk and its author's program, where the command line does not give others.
void applyTalk(const CLI::App& app, RenderJob& job);

/// Throws UsageError on options that need --redistribute or --lookup nearest.
void checkTalkOptions(const CLI::App& app, const RenderJob& job);

}  // namespace importon
