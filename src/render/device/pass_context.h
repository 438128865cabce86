/// What the owners of a render share: the device with its buffers, and the pass at hand.
#pragma once
#include "accel/bvh.h"
#include "base/log.h"
#include "render/device/loaded_device.h"
#include "render/device/workspace.h"
#include "render/device_scene/device_scene.h"
#include "render/plan/pass_sums.h"
#include "render/render_stats.h"
#include "render/resume/kept.h"

namespace importon {

/// Where a render gets what can be there before it begins.
struct RenderSources {
  DeviceSource device = loadDevice;
  std::function<std::shared_ptr<const Bvh>()> tree = {};  // over the scene; empty: it is built
};

/// Builds the tree over the scene, with a progress line when it takes long. `seconds`: what it took. Throws SceneError.
[[nodiscard]] std::shared_ptr<const Bvh> buildSceneBvh(const Scene& scene, const RenderJob& job, Log& log,
                                                       double& seconds);

struct PassContext {
  /// Loads the device and uploads the scene. Job, scene, log and stats must last as long. Throws DeviceError,
  /// SceneError.
  PassContext(const RenderJob& job, const Scene& scene, Log& log, RenderStats& stats, const RenderSources& sources);
  PassContext(const PassContext&) = delete;
  PassContext& operator=(const PassContext&) = delete;

  const RenderJob& job;
  const Scene& scene;
  Log& log;
  RenderStats& stats;
  FeatureSet features;
  std::shared_ptr<LoadedDevice> device;
  DeviceScene deviceScene;
  PassPlan plan;
  PassSize now;  // of the pass at hand
  Parameters parameters;
  Workspace work;
  gpu::Recorder recorder;

  [[nodiscard]] Stage stage() { return {device->context, recorder, device->kernels, work, deviceScene}; }
  [[nodiscard]] bool hasMaps() const { return job.integrator == Integrator::photon; }
  [[nodiscard]] std::uint64_t pixels() const { return std::uint64_t{parameters.width} * parameters.height; }
  /// pixels/m², if it were the same everywhere.
  [[nodiscard]] float meanImportance() const;

  /// Sets the parameters of a pass that follows those of `before`; upload() hands them to the device.
  void setPass(int pass, const PassSums& before);
  /// Hands the parameters to the device.
  void upload() { work.parameters.upload(std::span<const Parameters>(&parameters, 1)); }
  /// Hands the parameters to the device, and has all counters at zero.
  void begin();
  /// The same for photons that are in no map, as if it were the first pass.
  void beginPilot();

  void addKept(std::vector<Kept>& state) {
    if (hasMaps()) state.push_back(keep("lights seen", work.lightsSeen));
  }

 private:
  struct Loaded;
  PassContext(const RenderJob& job, const Scene& scene, Log& log, RenderStats& stats, Loaded loaded);
  static Loaded load(const RenderJob& job, const Scene& scene, Log& log, PhaseSeconds& seconds,
                     const RenderSources& sources);
};

}  // namespace importon
