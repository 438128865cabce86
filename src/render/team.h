/// A render on one device or on several.
#pragma once
#include <exception>
#include <filesystem>

#include "render/plan/stop_rule.h"
#include "render/render.h"
#include "render/renderer.h"

namespace importon {

/// Seconds since the job began.
using Elapsed = std::function<double()>;

/// A renderer with a device of its own, and how far it is.
struct Member {
  RenderJob job;                         // with its device and its seed
  std::size_t position = 0;              // in the list of devices
  std::string prefix = {};               // of its names in a checkpoint
  std::unique_ptr<Renderer> renderer{};  // null: not open yet
  std::optional<StopRule> rule{};
  int passes = 0;
  int share = 0;  // of the passes of the job: as many it makes in all

  /// Makes a pass, and further ones that can be expected to be done by `end`, as far as the rule has any. How many.
  int render(const Elapsed& elapsed, double end, const std::atomic<bool>& isInterrupted);
  /// All that a checkpoint holds of it but the passes.
  [[nodiscard]] std::vector<Kept> state();
};

/// The devices of a job, each with a seed of its own, at work at once on one image, whose films are added up. One that
/// fails leaves with a warning, and what it has made with it; the error of the last one is thrown. Whatever runs on
/// devices throws DeviceError. docs/devices.md says what each device does.
class Team {
 public:
  /// Opens the devices. Job, scene and log must last. Throws UsageError, SceneError.
  Team(const RenderJob& job, const Scene& scene, Log& log, const RenderSources& sources);

  /// Of the run: all that decides the bits of the image but the number of passes.
  [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_; }
  /// Before the first pass.
  void prepare();
  /// Goes on from a checkpoint, read from `file`; a device that is not in it begins anew. Throws SceneError.
  void restore(const Checkpoint& checkpoint, const std::filesystem::path& file);
  [[nodiscard]] std::vector<CheckpointBlock> blocks();

  /// Estimates the error of the image so far if it is time for that.
  void estimate(const Elapsed& elapsed);
  /// A pass on each device; with a time budget more on those that are faster than others. False: there was none to
  /// make.
  [[nodiscard]] bool renderRound(const Elapsed& elapsed, const std::atomic<bool>& isInterrupted);

  [[nodiscard]] int passes() const;
  [[nodiscard]] int maxPasses() const { return maxPasses_; }
  /// What the rule of the first device has been told of the error of them all.
  [[nodiscard]] const StopRule& rule() const { return *members_.front()->rule; }
  [[nodiscard]] double secondsLeft(double elapsed) const;
  /// Of all devices, so far.
  [[nodiscard]] RenderStats stats() const;
  /// The image so far, without AOVs.
  [[nodiscard]] Image image();
  /// The image with its layers, and all statistics.
  [[nodiscard]] RenderResult finish();

 private:
  using Work = std::function<void(Member&)>;
  void onEach(const Work& work);
  void inTurn(const Work& work);
  void dropFailed(std::span<const std::exception_ptr> errors);
  [[nodiscard]] FilmSums film();
  [[nodiscard]] FilmLayers resolve(FilmSums& film);
  [[nodiscard]] Image imageWithLayers(const FilmLayers& layers);
  void sharePasses();
  [[nodiscard]] bool isBehind(const Member& member) const;
  [[nodiscard]] bool areLevel() const;

  const RenderJob& job_;
  Log& log_;
  std::vector<std::unique_ptr<Member>> members_;  // those whose devices have not failed
  std::uint64_t fingerprint_ = 0;
  int maxPasses_ = 0;
  double treeSeconds_ = 0, resolveSeconds_ = 0;
};

}  // namespace importon
