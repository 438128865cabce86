#include "app/render_loaded.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "app/progress.h"
#include "app/reference_errors.h"
#include "app/stats_file.h"
#include "base/clock.h"
#include "fmt/format.h"
#include "fmt/ranges.h"
#include "io/image.h"
#include "io/output_file.h"
#include "io/picture_file.h"
#include "render/options/aov_table.h"
#include "render/options/gather_source.h"
#include "render/plan/camera_matrices.h"
#include "render/resume/job_fingerprint.h"

namespace importon {
namespace {

void warnOfUnusedOptions(const RenderCommand& command, Log& log) {
  if (command.job.integrator != Integrator::path || command.photonOptions.empty()) return;
  log.warn("unused option", fmt::format("the path tracer has no use for {}", fmt::join(command.photonOptions, ", ")));
}

bool writes(const RenderJob& job, PictureKind kind) {
  return pictureKind(job.output, PictureKind::exr) == kind ||
         (!job.png.empty() && pictureKind(job.png, PictureKind::png) == kind);
}

void warnOfUnusedLook(const RenderCommand& command, Log& log) {
  const RenderJob& job = command.job;
  const bool hasPng = writes(job, PictureKind::png), hasJpeg = writes(job, PictureKind::jpeg);
  const auto warn = [&](const char* name, const char* why) {
    if (std::ranges::count(command.given, name) > 0)
      log.warn("unused option", fmt::format("{} is of the PNG, and {}", name, why));
  };
  if (!hasPng && !hasJpeg)
    for (const char* name : {"--exposure", "--tone-map"}) warn(name, "no --png is asked for");
  if (!hasPng) warn("--png-depth", "none is asked for");
  if (job.isTransparent && hasJpeg)
    log.warn("no opacity", "a JPEG has no opacity: the picture stands in front of black");
  if (job.isTransparent && writes(job, PictureKind::hdr))
    log.warn("no opacity", "a Radiance picture has no opacity: the picture stands in front of black");
}

void tellGatherSource(const RenderJob& job, Log& log) {
  const std::string reason = photonReason(job);
  if (job.integrator == Integrator::path) return;
  log.detail(fmt::format("gather rays read {}{}{}", gatherSourceName(job), reason.empty() ? "" : ", by ", reason));
}

/// What shows light; but variance and error are of no use where small numbers are rounded.
bool isColor(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  if (dot == std::string::npos) return true;  // R, G, B, A
  const AovRow& row = aovRow(channel.substr(0, dot));
  return row.suffixes == "RGB" && row.source != AovSource::filmVariance && row.source != AovSource::filmError;
}

void makeColorsHalf(Image& image, Log& log) {
  constexpr float kMost = 65504;
  std::size_t tooBright = 0;
  for (Channel& channel : image.channels) {
    channel.isHalf = isColor(channel.name);
    if (channel.isHalf)
      tooBright +=
          static_cast<std::size_t>(std::ranges::count_if(channel.values, [](float v) { return std::abs(v) > kMost; }));
  }
  if (tooBright > 0)
    log.warn("too bright for --half", fmt::format("{} values above 65504 are written as that, by --half", tooBright));
}

/// Nothing that changes from run to run, so that the same job gives the same bytes.
void addAttributes(const RenderJob& job, const Scene& scene, RenderResult& result) {
  auto& attributes = result.image.attributes;
  attributes["software"] = std::string("importon ") + IMPORTON_VERSION;
  attributes["importon:version"] = IMPORTON_VERSION;
  attributes["importon:scene"] = job.scene.filename().string();
  attributes["importon:job"] = fmt::format("{:016x}", imageFingerprint(job, scene));
  attributes["importon:seed"] = fmt::format("{}", fmt::join(result.seeds, " "));
  attributes["importon:passes"] = std::to_string(result.stats.passes);
  std::vector<std::string> names;
  for (const DeviceStats& device : result.stats.devices) names.push_back(device.name);
  attributes["importon:device"] = fmt::format("{}", fmt::join(names, " + "));
  const CameraMatrices matrices = cameraMatrices(scene, job);
  result.image.matrices = {{"worldToCamera", matrices.worldToCamera}, {"worldToNDC", matrices.worldToNdc}};
}

std::uint64_t peakHostBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

void writeOutputs(const RenderJob& job, const Scene& scene, Log& log, RenderResult& result, Clock::time_point start) {
  const Clock::time_point outputStart = Clock::now();
  addAttributes(job, scene, result);
  if (job.hasHalfColors) makeColorsHalf(result.image, log);
  writePicture(job.output, result.image, job.look, PictureKind::exr);
  if (!job.png.empty()) writePicture(job.png, result.image, job.look, PictureKind::png);
  result.stats.hostPeakBytes = peakHostBytes();
  result.stats.seconds.output = secondsSince(outputStart);
  result.stats.seconds.total = secondsSince(start);
  if (!job.stats.empty()) writeTextFile(job.stats, statsJson(job, result.stats, log.warnings()));
}

}  // namespace

void checkOutputs(const RenderJob& job) {
  for (const std::filesystem::path& file : {job.output, job.png, job.stats, job.checkpoint}) {
    if (!file.empty()) checkWritable(file);
  }
}

void tellOfOptions(const RenderCommand& command, Log& log) {
  warnOfUnusedOptions(command, log);
  warnOfUnusedLook(command, log);
  tellGatherSource(command.job, log);
}

RenderOutcome renderLoaded(const RenderJob& job, const LoadedScene& loaded, Log& log,
                           const std::atomic<bool>& isInterrupted, Clock::time_point start,
                           const RenderSources& sources, const std::string& progress) {
  ReferenceErrors errors(job, loaded.scene);
  const auto afterPass = [&](const RenderProgress& now) {
    log.progress(progress + progressLine(now));
    errors.measure(now);
  };
  RenderResult result = render(job, loaded.scene, log, isInterrupted, afterPass, start, sources);
  log.endProgress();
  errors.report(result.stats.error, result.image);
  result.stats.seconds.load = loaded.seconds;
  if (sources.tree) result.stats.seconds.bvh = loaded.treeSeconds;

  if (result.wasInterrupted && result.stats.passes == 0) {
    log.note("interrupted before the first pass was done: no image is written");
    return {ExitStatus::interrupted};
  }
  if (result.wasInterrupted && job.frame) {  // a sequence has whole frames, or --skip-existing would keep this one
    log.note("interrupted: this frame is not written");
    return {ExitStatus::interrupted};
  }
  writeOutputs(job, loaded.scene, log, result, start);
  log.detail(fmt::format("{} passes in {:.2f} s", result.stats.passes, secondsSince(start)));
  RenderOutcome outcome{ExitStatus::ok, std::move(result.stats)};
  if (result.wasInterrupted) outcome.status = ExitStatus::interrupted;
  if (result.lacksCheckpoint) outcome.status = ExitStatus::output;
  return outcome;
}

}  // namespace importon
