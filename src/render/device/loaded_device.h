/// A device with the kernels of a render. Loading costs most of a small render, so renders of one kind can share one.
#pragma once
#include <functional>
#include <future>
#include <memory>

#include "gpu/context.h"
#include "render/device/kernel_set.h"

namespace importon {

struct LoadedDevice {
  LoadedDevice(const FeatureSet& features, const RenderJob& job);
  gpu::Context context;
  KernelSet kernels;
  std::future<void> compilation;  // of kernels, ahead of their use
};

/// Where a render gets its device from.
using DeviceSource = std::function<std::shared_ptr<LoadedDevice>(const FeatureSet&, const RenderJob&)>;

/// Opens the job's device and begins to compile the kernels for `features`. Throws DeviceError.
[[nodiscard]] std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job);

}  // namespace importon
