#include "render/device/loaded_device.h"

namespace importon {

std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job) {
  auto loaded = std::make_shared<LoadedDevice>(gpu::ContextOptions{job.device, job.validation});
  loaded->kernels = makeKernels(loaded->context, features, job);
  loaded->compilation = std::async(std::launch::async,
                                   [&device = *loaded, features, job] { compileAhead(device.kernels, features, job); });
  return loaded;
}

}  // namespace importon
