/// What a Kernel owns.
#pragma once
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "gpu/handle.h"
#include "gpu/kernel.h"

namespace importon::gpu {

struct Kernel::Impl {
  std::shared_ptr<Device> device;  // shared: see Device
  const KernelCode* code = nullptr;
  std::uint32_t workgroupSize = 1;
  SetLayoutHandle setLayout;
  PipelineLayoutHandle pipelineLayout;
  std::vector<Specialization> constants;
  std::once_flag compiles;
  PipelineHandle pipeline;  // null until compiled
  std::atomic<double> compileMilliseconds = 0;
};

/// What a buffer of that kind is bound as.
[[nodiscard]] VkDescriptorType descriptorType(BufferKind kind, const Limits& limits);

}  // namespace importon::gpu
