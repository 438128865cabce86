/// A device with the kernels of a render. Loading costs most of a small render, so renders can share one.
#pragma once
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

#include "gpu/context.h"
#include "render/device/kernel_set.h"

namespace importon {

/// A device, and all kernels that were made for it so far.
struct OpenDevice {
  /// Throws DeviceError.
  explicit OpenDevice(const gpu::ContextOptions& options);
  gpu::Context context;
  std::shared_ptr<gpu::KernelCache> kernels;
};

struct LoadedDevice {
  /// Opens the job's device. Throws DeviceError.
  LoadedDevice(const FeatureSet& features, const RenderJob& job);
  /// Begins to compile what `opened` lacks.
  LoadedDevice(std::shared_ptr<OpenDevice> opened, const FeatureSet& features, const RenderJob& job);
  std::shared_ptr<OpenDevice> open;
  gpu::Context& context;
  KernelSet kernels;
  std::future<void> compilation;  // of kernels, ahead of their use
};

/// Where a render gets its device from.
using DeviceSource = std::function<std::shared_ptr<LoadedDevice>(const FeatureSet&, const RenderJob&)>;

/// Opens the job's device and begins to compile the kernels for `features`. Throws DeviceError.
[[nodiscard]] std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job);

/// Open devices for renders that come one after another, whatever their features. From any thread.
class SharedDevices {
 public:
  /// As loadDevice; opens a device that no render before has asked for, or that was lost since.
  [[nodiscard]] std::shared_ptr<LoadedDevice> load(const FeatureSet& features, const RenderJob& job);
  /// False where none could be opened.
  [[nodiscard]] bool areOpen() const { return !open_.empty(); }
  /// The next render opens its devices anew.
  void drop() { open_.clear(); }

 private:
  using Asked = std::tuple<std::string, bool, bool>;  // device, validation, without cache
  std::mutex mutex_;
  std::map<Asked, std::shared_ptr<OpenDevice>> open_;
};

}  // namespace importon
