#include "render/loaded_device.h"

#include "fmt/format.h"

namespace importon {

std::shared_ptr<LoadedDevice> loadDevice(const FeatureSet& features, const RenderJob& job) {
  auto loaded = std::make_shared<LoadedDevice>(gpu::ContextOptions{job.device, job.validation});
  loaded->kernels = makeKernels(loaded->context, features, job);
  loaded->compilation = std::async(std::launch::async, [&device = *loaded, features, job] {
    compileAhead(device.kernels, features, job);
  });
  return loaded;
}

std::shared_ptr<LoadedDevice> DeviceCache::find(const FeatureSet& features, const RenderJob& job) {
  const std::string key = fmt::format("{} {} {}", job.validation, describeKernels(features, job), job.device);
  if (const auto found = devices_.find(key); found != devices_.end()) return found->second;
  if (devices_.size() >= kMost) devices_.clear();
  return devices_[key] = loadDevice(features, job);
}

}  // namespace importon
