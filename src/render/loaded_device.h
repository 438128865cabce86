/// A device with the kernels of a render. Loading costs most of a small render, so renders of one kind can share one.
#pragma once
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>

#include "gpu/context.h"
#include "render/kernel_set.h"

namespace importon {

struct LoadedDevice {
  explicit LoadedDevice(const gpu::ContextOptions& options) : context(options) {}
  gpu::Context context;
  KernelSet kernels;
  std::future<void> compilation;  // of kernels, ahead of their use
};

/// Where a render gets its device from.
using DeviceSource = std::function<std::shared_ptr<LoadedDevice>(const FeatureSet&, const RenderJob&)>;

/// Opens the job's device and begins to compile the kernels for `features`. Throws DeviceError.
[[nodiscard]] std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job);

/// Keeps devices for renders that call for the same kernels, one after another. Not for several threads.
class DeviceCache {
 public:
  [[nodiscard]] std::shared_ptr<LoadedDevice> find(const FeatureSet& features, const RenderJob& job);
  void clear() { devices_.clear(); }

 private:
  static constexpr std::size_t kMost = 12;  // each holds some tens of MiB of compiled kernels
  std::map<std::string, std::shared_ptr<LoadedDevice>> devices_;
};

}  // namespace importon
