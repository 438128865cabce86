#include <sys/resource.h>

#include "app/commands.h"
#include "app/load_scene.h"
#include "app/progress.h"
#include "app/reference_errors.h"
#include "app/stats_file.h"
#include "base/clock.h"
#include "fmt/format.h"
#include "fmt/ranges.h"
#include "io/image.h"
#include "io/output_file.h"
#include "render/options/gather_source.h"
#include "render/render.h"
#include "render/resume/job_fingerprint.h"

namespace importon {
namespace {

void checkOutputs(const RenderJob& job) {
  for (const std::filesystem::path& file : {job.output, job.png, job.stats, job.checkpoint}) {
    if (!file.empty()) checkWritable(file);
  }
}

void warnOfUnusedOptions(const RenderCommand& command, Log& log) {
  if (command.job.integrator != Integrator::path || command.photonOptions.empty()) return;
  log.warn("unused option", fmt::format("the path tracer has no use for {}", fmt::join(command.photonOptions, ", ")));
}

void tellGatherSource(const RenderJob& job, Log& log) {
  const std::string reason = photonReason(job);
  if (job.integrator == Integrator::path) return;
  log.detail(fmt::format("gather rays read {}{}{}", gatherSourceName(job), reason.empty() ? "" : ", by ", reason));
}

/// Nothing that changes from run to run, so that the same job gives the same bytes.
void addAttributes(const RenderJob& job, const Scene& scene, RenderResult& result) {
  auto& attributes = result.image.attributes;
  attributes["importon:version"] = IMPORTON_VERSION;
  attributes["importon:scene"] = job.scene.filename().string();
  attributes["importon:job"] = fmt::format("{:016x}", imageFingerprint(job, scene));
  attributes["importon:seed"] = std::to_string(job.seed);
  attributes["importon:passes"] = std::to_string(result.stats.passes);
  attributes["importon:device"] = result.stats.deviceName;
}

std::uint64_t peakHostBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

void writeOutputs(const RenderJob& job, const Scene& scene, const Log& log, RenderResult& result,
                  Clock::time_point start) {
  const Clock::time_point outputStart = Clock::now();
  addAttributes(job, scene, result);
  writeExr(job.output, result.image);
  if (!job.png.empty()) writePng(job.png, result.image);
  if (job.stats.empty()) return;
  result.stats.hostPeakBytes = peakHostBytes();
  result.stats.seconds.output = secondsSince(outputStart);
  result.stats.seconds.total = secondsSince(start);
  writeTextFile(job.stats, statsJson(job, result.stats, log.warnings()));
}

}  // namespace

ExitStatus runRender(const RenderCommand& command, const std::atomic<bool>& isInterrupted, Clock::time_point start) {
  const RenderJob& job = command.job;
  checkOutputs(job);
  Log log(command.verbosity);
  warnOfUnusedOptions(command, log);
  tellGatherSource(job, log);

  const Clock::time_point loadStart = Clock::now();
  const Scene scene = loadScene(job, log);
  const double loadSeconds = secondsSince(loadStart);

  ReferenceErrors errors(job, scene);
  const auto afterPass = [&](const RenderProgress& progress) {
    log.progress(progressLine(progress));
    errors.measure(progress);
  };
  RenderResult result = render(job, scene, log, isInterrupted, afterPass, start);
  log.endProgress();
  errors.report(result.stats.error);
  result.stats.seconds.load = loadSeconds;

  if (result.wasInterrupted && result.stats.passes == 0) {
    log.note("interrupted before the first pass was done: no image is written");
    return ExitStatus::interrupted;
  }
  writeOutputs(job, scene, log, result, start);
  log.detail(fmt::format("{} passes in {:.2f} s", result.stats.passes, secondsSince(start)));
  if (result.lacksCheckpoint) return ExitStatus::output;
  return result.wasInterrupted ? ExitStatus::interrupted : ExitStatus::ok;
}

}  // namespace importon
