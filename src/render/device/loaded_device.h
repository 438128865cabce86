/// A device with the kernels of a render. Loading costs most of a small render, so renders can share one.
#pragma once
#include <functional>
#include <future>
#include <memory>

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

/// One device for renders that come one after another, whatever their features.
class SharedDevice {
 public:
  /// As loadDevice; opens a device for the first render, and for one that asks for another device than the last.
  [[nodiscard]] std::shared_ptr<LoadedDevice> load(const FeatureSet& features, const RenderJob& job);
  /// False where the last device could not be opened.
  [[nodiscard]] bool isOpen() const { return open_ != nullptr; }
  /// The next render opens a device anew.
  void drop() { open_.reset(); }

 private:
  std::shared_ptr<OpenDevice> open_;  // null: none
  gpu::ContextOptions options_;       // of it
};

}  // namespace importon
