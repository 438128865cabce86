#include "render/device/loaded_device.h"

namespace importon {
namespace {

// Kernels that are kept: those of some scenes of different kinds. Each holds up to a MiB of compiled code.
constexpr std::size_t kMostKernels = 600;

}  // namespace

OpenDevice::OpenDevice(const gpu::ContextOptions& options)
    : context(options), kernels(std::make_shared<gpu::KernelCache>(context)) {}

LoadedDevice::LoadedDevice(const FeatureSet& features, const RenderJob& job)
    : LoadedDevice(std::make_shared<OpenDevice>(gpu::ContextOptions{job.device, job.validation}), features, job) {}

LoadedDevice::LoadedDevice(std::shared_ptr<OpenDevice> opened, const FeatureSet& features, const RenderJob& job)
    : open(std::move(opened)),
      context(open->context),
      kernels(open->kernels, constantsOf(features, job, context.limits().isCpu), features.hasAlpha),
      compilation(std::async(std::launch::async, [this, features, job] { compileAhead(kernels, features, job); })) {}

std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job) {
  return std::make_shared<LoadedDevice>(features, job);
}

std::shared_ptr<LoadedDevice> SharedDevices::load(const FeatureSet& features, const RenderJob& job) {
  const std::lock_guard lock(mutex_);
  const Asked asked{job.device, job.validation};
  std::erase_if(open_, [](const auto& entry) { return entry.second->context.isLost(); });
  auto found = open_.find(asked);
  if (found == open_.end())
    found = open_.emplace(asked, std::make_shared<OpenDevice>(gpu::ContextOptions{job.device, job.validation})).first;
  const std::shared_ptr<OpenDevice>& open = found->second;
  if (open->kernels->size() > kMostKernels) open->kernels->clear();
  return std::make_shared<LoadedDevice>(open, features, job);
}

}  // namespace importon
