/// Sequences: frames of animations, and turntables. docs/animation.md.
#pragma once
#include "app/command_line.h"
#include "base/log.h"

namespace importon {

/// A job for each frame, with the files that it writes; of a turntable of one pose, one for all frames, which share the
/// scene. Throws UsageError on what one file or one time cannot serve all frames for, and on names without a number.
[[nodiscard]] BatchCommand makeSequenceCommand(const RenderCommand& common);

/// The job of one frame of `job`: its number stands in its names, and its seed is its own if that is asked for.
[[nodiscard]] RenderJob frameJob(const RenderJob& job, std::int64_t frame);

/// Leaves out the frames whose files are all there, with a note, if that is asked for.
[[nodiscard]] BatchCommand withoutMadeFrames(const BatchCommand& command, Log& log);

}  // namespace importon
