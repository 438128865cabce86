#include "app/render_loaded.h"

#include <sys/resource.h>

#include <algorithm>

#include "app/progress.h"
#include "app/reference_errors.h"
#include "app/stats_file.h"
#include "base/clock.h"
#include "fmt/format.h"
#include "fmt/ranges.h"
#include "io/image.h"
#include "io/output_file.h"
#include "io/png.h"
#include "render/options/gather_source.h"
#include "render/resume/job_fingerprint.h"

namespace importon {
namespace {

void warnOfUnusedOptions(const RenderCommand& command, Log& log) {
  if (command.job.integrator != Integrator::path || command.photonOptions.empty()) return;
  log.warn("unused option", fmt::format("the path tracer has no use for {}", fmt::join(command.photonOptions, ", ")));
}

void warnOfUnusedLook(const RenderCommand& command, Log& log) {
  if (!command.job.png.empty()) return;
  for (const char* name : {"--exposure", "--tone-map"})
    if (std::ranges::count(command.given, name) > 0)
      log.warn("unused option", fmt::format("{} is of the PNG, and no --png is asked for", name));
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
  attributes["importon:seed"] = fmt::format("{}", fmt::join(result.seeds, " "));
  attributes["importon:passes"] = std::to_string(result.stats.passes);
  std::vector<std::string> names;
  for (const DeviceStats& device : result.stats.devices) names.push_back(device.name);
  attributes["importon:device"] = fmt::format("{}", fmt::join(names, " + "));
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
  if (!job.png.empty()) writePng(job.png, result.image, job.look);
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
