/// What a Kernel owns.
#pragma once
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "gpu/handle.h"
#include "gpu/kernel.h"
#include "gpu/spirv_reflection.h"

namespace importon::gpu {

struct Kernel::Impl {
  std::shared_ptr<Device> device;  // shared: see Device
  std::vector<ReflectedBinding> bindings;
  std::uint32_t pushConstantBytes = 0;
  std::uint32_t workgroupSize = 1;
  SetLayoutHandle setLayout;
  PipelineLayoutHandle pipelineLayout;
  std::span<const std::uint32_t> spirv;
  std::vector<Specialization> constants;
  std::once_flag compiles;
  PipelineHandle pipeline;  // null until compiled
};

[[nodiscard]] VkDescriptorType descriptorType(BindingKind kind);

}  // namespace importon::gpu
