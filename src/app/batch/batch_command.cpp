#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "app/batch/batch_summary.h"
#include "app/batch/job_files.h"
#include "app/batch/scene_ahead.h"
#include "app/batch/sequence_camera.h"
#include "app/batch/sequence_command.h"
#include "app/commands.h"
#include "app/output_folder.h"
#include "base/clock.h"
#include "fmt/format.h"
#include "io/image.h"
#include "io/output_file.h"
#include "render/plan/camera_setup.h"

namespace importon {
namespace {

namespace fs = std::filesystem;

/// The folders are there and can be written to. Throws OutputError.
void prepareFolders(const BatchCommand& command) {
  for (const fs::path& folder : {command.folder, command.pngFolder}) {
    constexpr std::array kProbe{".importon-probe"};
    if (!folder.empty()) makeFolder(folder, kProbe);
  }
  if (!command.summary.empty()) checkWritable(command.summary);
  if (!command.isSequence) return;
  const fs::path& stats = command.entries.front().render.job.stats;  // of each frame
  if (!stats.empty()) checkWritable(stats);
}

/// By what --camera chooses this camera and no other.
std::string choiceOf(const Scene& scene, std::size_t index) {
  const Camera& camera = scene.cameras[index];
  RenderJob job;
  for (const std::string& name : {camera.name, camera.nodeName, std::to_string(index)}) {
    job.camera = name;
    if (!name.empty() && &chooseCamera(scene, job) == &camera) return name;
  }
  throw SceneError(fmt::format("camera {} cannot be told from others by name", index), scene.file.string(),
                   "give it a name of its own");
}

/// The name or index of the camera that a job renders.
std::string labelOf(const Scene& scene, const RenderJob& job) {
  const auto index = static_cast<std::size_t>(&chooseCamera(scene, job) - scene.cameras.data());
  return cameraLabel(scene.cameras, index);
}

/// The jobs of an entry of which the scene is there.
std::vector<RenderJob> jobsOf(const BatchEntry& entry, const Scene& scene) {
  constexpr std::size_t kMostCameras = 10'000;
  if (entry.hasAllCameras && scene.cameras.size() > kMostCameras)
    throw SceneError("the scene has more than 10,000 cameras", scene.file.string(), "choose some in a --list");
  std::vector<RenderJob> jobs;
  for (std::size_t i = 0; entry.hasAllCameras && i < scene.cameras.size(); ++i) {
    jobs.push_back(entry.render.job);
    jobs.back().camera = choiceOf(scene, i);
    addCamera(jobs.back(), cameraLabel(scene.cameras, i));
  }
  for (const std::int64_t frame : entry.frames) jobs.push_back(frameJob(entry.render.job, frame));
  if (!entry.hasAllCameras && entry.frames.empty()) jobs.push_back(entry.render.job);
  return jobs;
}

class Batch {
 public:
  Batch(const BatchCommand& command, const std::atomic<bool>& isInterrupted, Clock::time_point start)
      : command_(command), isInterrupted_(isInterrupted), start_(start), jobStart_(start) {}

  ExitStatus run();

 private:
  void runEntry(const BatchEntry& entry, SceneAhead& ahead);
  void renderAll(const BatchEntry& entry, PreparedScene& scene, Log& log);
  void renderJob(const RenderJob& job, LoadedScene& loaded, std::shared_ptr<const Bvh> tree, Log& log);
  RenderOutcome tryTwice(const RenderJob& job, const LoadedScene& loaded, std::shared_ptr<const Bvh> tree, Log& log);
  void fail(const RenderJob& job, const std::string& camera, const std::exception& exception, Log& log);
  void skip(const RenderJob& job);
  void record(BatchResult result);
  void tellOfEnd() const;
  void release(Log& log) { command_.isSequence ? log.release(told_) : log.release(); }
  [[nodiscard]] std::string place() const;

  const BatchCommand& command_;
  const std::atomic<bool>& isInterrupted_;
  Clock::time_point start_, jobStart_;  // of the process; of the present job
  std::size_t entry_ = 0;               // number of the present one, from 1
  std::set<std::string> told_;          // by frames of a sequence
  SequenceCamera sequenceCamera_;
  SharedDevices devices_;
  bool hasDoubtedDevice_ = false;  // the last job failed on a fresh one
  std::unique_ptr<SceneAhead> next_;
  std::vector<BatchResult> results_;
};

ExitStatus Batch::run() {
  const std::vector<BatchEntry>& entries = command_.entries;
  if (!entries.empty()) next_ = std::make_unique<SceneAhead>(entries.front().render);
  for (const BatchEntry& entry : entries) {
    ++entry_;
    if (isInterrupted_) {
      skip(entry.render.job);
      continue;
    }
    const std::unique_ptr<SceneAhead> ahead = std::move(next_);
    runEntry(entry, *ahead);
  }
  if (!command_.summary.empty()) writeTextFile(command_.summary, summaryJson(command_, results_, secondsSince(start_)));
  tellOfEnd();
  return worstStatus(results_);
}

void Batch::runEntry(const BatchEntry& entry, SceneAhead& ahead) {
  std::optional<PreparedScene> scene;
  Log& log = ahead.log();
  try {
    scene = ahead.take();
  } catch (const std::exception& exception) {
    release(log);
    fail(entry.render.job, "", exception, log);
  }
  if (entry_ < command_.entries.size()) next_ = std::make_unique<SceneAhead>(command_.entries[entry_].render);
  if (!scene) return;
  release(log);
  tellOfOptions(entry.render, log);
  renderAll(entry, *scene, log);
}

void Batch::renderAll(const BatchEntry& entry, PreparedScene& scene, Log& log) {
  std::vector<RenderJob> jobs;
  try {
    jobs = jobsOf(entry, scene.loaded.scene);
  } catch (const std::exception& exception) {
    fail(entry.render.job, "", exception, log);
  }
  const std::vector<Camera> cameras = scene.loaded.scene.cameras;
  for (const RenderJob& job : jobs) {
    const bool isLast = &job == &jobs.back();
    scene.loaded.scene.cameras = cameras;
    if (isInterrupted_)
      skip(job);
    else
      renderJob(job, scene.loaded, isLast ? std::move(scene.tree) : scene.tree, log);
  }
}

void Batch::renderJob(const RenderJob& job, LoadedScene& loaded, std::shared_ptr<const Bvh> tree, Log& log) {
  std::string camera = job.camera;
  try {
    sequenceCamera_.place(job, loaded.scene);
    camera = labelOf(loaded.scene, job);
    checkOutputs(job);
    RenderJob told = job;
    if (!job.stats.empty()) told.commandLine = command_.commandLine;
    RenderOutcome outcome = tryTwice(told, loaded, std::move(tree), log);
    BatchResult result{job, camera, outcome.status, "", secondsSince(jobStart_), std::move(outcome.stats), {}};
    if (result.stats) log.note(fmt::format("{} in {:.2f} s, {}", job.output.string(), result.seconds, place()));
    if (result.status == ExitStatus::output) result.error = "the checkpoint could not be written";
    if (!result.stats) result.error = "interrupted before it was done";
    result.warnings = log.warnings();
    record(std::move(result));
  } catch (const std::exception& exception) {
    fail(job, camera, exception, log);
  }
}

/// Once more on a fresh device where an open one fails, unless a fresh one has just failed.
RenderOutcome Batch::tryTwice(const RenderJob& job, const LoadedScene& loaded, std::shared_ptr<const Bvh> tree,
                              Log& log) {
  const auto attempt = [&] {
    const RenderSources sources{
        [this](const FeatureSet& features, const RenderJob& theJob) { return devices_.load(features, theJob); },
        [&] { return tree ? std::exchange(tree, nullptr) : buildTree(loaded.scene, job); }};
    RenderOutcome outcome = renderLoaded(job, loaded, log, isInterrupted_, jobStart_, sources, place() + "  ");
    hasDoubtedDevice_ = false;
    return outcome;
  };
  try {
    return attempt();
  } catch (const DeviceError& error) {
    const bool wereOpen = devices_.areOpen();
    devices_.drop();
    if (!wereOpen || std::exchange(hasDoubtedDevice_, true)) throw;
    log.endProgress();
    log.warn("device failure", fmt::format("{}; now once more, with a fresh device", error.what()));
  }
  jobStart_ = Clock::now();
  try {
    return attempt();
  } catch (const DeviceError&) {
    devices_.drop();
    throw;
  }
}

void Batch::fail(const RenderJob& job, const std::string& camera, const std::exception& exception, Log& log) {
  const Failure failure = failureOf(exception);
  const bool namesScene = failure.message.find(job.scene.string()) != std::string::npos;
  log.endProgress();
  log.error((namesScene ? "" : job.scene.filename().string() + ": ") + failure.message);
  record({job, camera, failure.status, failure.message, secondsSince(jobStart_), {}, log.warnings()});
}

void Batch::skip(const RenderJob& job) {
  record({job, job.camera, ExitStatus::interrupted, "not begun: interrupted", 0});
}

/// The next job begins.
void Batch::record(BatchResult result) {
  results_.push_back(std::move(result));
  jobStart_ = Clock::now();
}

/// Which of how many: frames of a sequence, or entries.
std::string Batch::place() const {
  const std::size_t entries = command_.entries.size(), frames = command_.entries.front().frames.size();
  return frames > 0 ? fmt::format("{}/{}", results_.size() + 1, frames) : fmt::format("{}/{}", entry_, entries);
}

void Batch::tellOfEnd() const {
  Log log(command_.verbosity);
  const auto made = std::ranges::count_if(results_, [](const BatchResult& r) { return r.stats.has_value(); });
  const auto skipped = std::ranges::count_if(
      results_, [](const BatchResult& r) { return r.status == ExitStatus::interrupted && !r.stats; });
  std::string text = fmt::format("{} of {} pictures in {:.1f} s", made, results_.size(), secondsSince(start_));
  if (skipped > 0) text += fmt::format("; interrupted, so {} are not made", skipped);
  log.note(text);
}

}  // namespace

ExitStatus runBatch(const BatchCommand& command, const std::atomic<bool>& isInterrupted, Clock::time_point start) {
  prepareFolders(command);
  if (!command.isSequence) return Batch(command, isInterrupted, start).run();
  Log log(command.verbosity);
  const BatchCommand left = withoutMadeFrames(command, log);
  return Batch(left, isInterrupted, start).run();
}

}  // namespace importon
