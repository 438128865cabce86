#include "app/batch/sequence_command.h"

#include <algorithm>
#include <array>
#include <utility>

#include "app/batch/batch_options.h"
#include "app/batch/frame_names.h"
#include "app/batch/job_files.h"
#include "base/error.h"
#include "fmt/format.h"

namespace importon {
namespace {

namespace fs = std::filesystem;

constexpr std::array kOfAFrame{&RenderJob::output, &RenderJob::png, &RenderJob::stats, &RenderJob::reference};

/// What a sequence cannot be made of.
void checkSequence(const RenderCommand& common) {
  const RenderJob& job = common.job;
  if (isBatch(common))
    throw UsageError("--frames and --turntable are of one scene and one camera", "command line",
                     "give one scene, without --list and --camera all");
  for (const auto& [name, file] : {std::pair("--checkpoint", &job.checkpoint), {"--resume", &job.resume}})
    if (!file->empty())
      throw UsageError(fmt::format("{} is of one picture, not of a sequence", name), file->string(),
                       "leave it out; --skip-existing goes on with the frames that are not made");
  checkFramePattern("--output", job.output);
  if (!job.png.empty()) checkFramePattern("--png", job.png);
  if (!job.reference.empty()) checkFramePattern("--reference", job.reference);
  if (hasFrameNumber(job.stats)) checkFramePattern("--stats", job.stats);
}

/// Names of different patterns may be alike for some frames.
void checkFrameFiles(const BatchCommand& command) {
  BatchCommand apart = command;
  apart.entries.clear();
  for (const BatchEntry& entry : command.entries) {
    if (entry.frames.empty()) apart.entries.push_back(entry);
    for (const std::int64_t frame : entry.frames) {
      apart.entries.emplace_back();
      apart.entries.back().render.job = frameJob(entry.render.job, frame);
    }
  }
  checkJobFiles(apart);
}

fs::path folderOf(const fs::path& file) {
  if (file.empty()) return {};
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool isMade(const RenderJob& job) {
  std::error_code ignored;
  return std::ranges::all_of(std::array{&job.output, &job.png}, [&](const fs::path* file) {
    return file->empty() || fs::is_regular_file(*file, ignored);
  });
}

}  // namespace

RenderJob frameJob(const RenderJob& job, std::int64_t frame) {
  RenderJob own = job;
  own.frame = frame;
  for (const auto file : kOfAFrame)
    if (!(own.*file).empty()) own.*file = frameName(own.*file, frame);
  if (job.hasSeedPerFrame) own.seed = static_cast<std::uint32_t>(job.seed + static_cast<std::uint64_t>(frame));
  return own;
}

BatchCommand makeSequenceCommand(const RenderCommand& common) {
  checkSequence(common);
  RenderCommand shared = common;
  BatchCommand command{
      {}, folderOf(common.job.output), folderOf(common.job.png), {}, common.job.commandLine, common.verbosity, true};
  if (!hasFrameNumber(common.job.stats)) command.summary = std::exchange(shared.job.stats, {});
  shared.job.commandLine.clear();
  if (const std::optional<FrameRange> frames = common.job.frames) {
    const double perSecond = common.job.framesPerSecond.value_or(RenderJob::kFramesPerSecond);
    for (std::int64_t frame = frames->first; frame <= frames->last; ++frame) {
      RenderCommand& render = command.entries.emplace_back(BatchEntry{shared}).render;
      render.job = frameJob(shared.job, frame);
      render.job.at = static_cast<double>(frame) / perSecond;
    }
  } else {
    BatchEntry& entry = command.entries.emplace_back(BatchEntry{shared});
    for (std::int64_t frame = 0; frame < *common.job.turntable; ++frame) entry.frames.push_back(frame);
  }
  checkFrameFiles(command);
  return command;
}

BatchCommand withoutMadeFrames(const BatchCommand& command, Log& log) {
  BatchCommand left = command;
  std::int64_t skipped = 0, all = 0;
  const auto isToBeSkipped = [&](const RenderJob& job) {
    ++all;
    const bool isSkipped = job.skipsMadeFrames && isMade(job);
    skipped += isSkipped ? 1 : 0;
    return isSkipped;
  };
  std::erase_if(left.entries, [&](BatchEntry& entry) {
    if (entry.frames.empty()) return isToBeSkipped(entry.render.job);
    std::erase_if(entry.frames, [&](std::int64_t frame) { return isToBeSkipped(frameJob(entry.render.job, frame)); });
    return entry.frames.empty();
  });
  if (skipped > 0) log.note(fmt::format("{} of {} frames are there already, and are left alone", skipped, all));
  return left;
}

}  // namespace importon
