#include "render/device/loaded_device.h"

namespace importon {

LoadedDevice::LoadedDevice(const FeatureSet& features, const RenderJob& job)
    : context({job.device, job.validation}),
      kernels(context, constantsOf(features, job, context.limits().isCpu), features.hasAlpha),
      compilation(std::async(std::launch::async, [this, features, job] { compileAhead(kernels, features, job); })) {}

std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job) {
  return std::make_shared<LoadedDevice>(features, job);
}

}  // namespace importon
