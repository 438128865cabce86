#include "render/device/loaded_device.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/hash.h"
#include "gpu/pipeline_file.h"
#include "kernels/registry.h"

namespace importon {
namespace {

// Kernels that are kept: those of some scenes of different kinds. Each holds up to a MiB of compiled code.
constexpr std::size_t kMostKernels = 600;

/// Of the kernels' sizes and some of their words: all of them would take as long as it takes to open a device. A driver
/// tells kernels by all their words, so a change that is missed costs nothing but room in the file.
std::uint64_t hashOfKernels() {
  constexpr std::size_t kApart = 64;
  ContentHash hash;
  for (const gpu::KernelCode* code : kernels::all()) {
    std::vector<std::uint32_t> words{static_cast<std::uint32_t>(code->placedEnd - code->begin)};
    for (const std::uint32_t* at = code->begin; code->placedEnd - at > 0;
         at += std::min<std::ptrdiff_t>(kApart, code->placedEnd - at))
      words.push_back(*at);
    hash.add(std::as_bytes(std::span(words)));
  }
  return hash.value();
}

gpu::ContextOptions contextOptions(const RenderJob& job) {
  gpu::ContextOptions options{job.device, job.validation};
  if (!job.leavesCache) options.cacheFolder = gpu::userCacheFolder();
  if (!options.cacheFolder.empty()) options.kernels = hashOfKernels();
  return options;
}

}  // namespace

OpenDevice::OpenDevice(const gpu::ContextOptions& options)
    : context(options), kernels(std::make_shared<gpu::KernelCache>(context)) {}

LoadedDevice::LoadedDevice(const FeatureSet& features, const RenderJob& job)
    : LoadedDevice(std::make_shared<OpenDevice>(contextOptions(job)), features, job) {}

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
  const Asked asked{job.device, job.validation, job.leavesCache};
  std::erase_if(open_, [](const auto& entry) { return entry.second->context.isLost(); });
  auto found = open_.find(asked);
  if (found == open_.end()) found = open_.emplace(asked, std::make_shared<OpenDevice>(contextOptions(job))).first;
  const std::shared_ptr<OpenDevice>& open = found->second;
  if (open->kernels->size() > kMostKernels) open->kernels->clear();
  return std::make_shared<LoadedDevice>(open, features, job);
}

}  // namespace importon
