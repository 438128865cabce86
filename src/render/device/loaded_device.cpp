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

std::shared_ptr<LoadedDevice> SharedDevice::load(const FeatureSet& features, const RenderJob& job) {
  if (open_ && (options_.device != job.device || options_.validation != job.validation)) drop();
  if (open_ && open_->kernels->size() > kMostKernels) open_->kernels->clear();
  options_ = {job.device, job.validation};
  if (!open_) open_ = std::make_shared<OpenDevice>(options_);
  return std::make_shared<LoadedDevice>(open_, features, job);
}

}  // namespace importon
