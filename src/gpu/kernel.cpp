#include "gpu/kernel.h"

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "base/error.h"
#include "gpu/kernel_impl.h"
#include "gpu/rounded_division.h"
#include "gpu/specialise_module.h"
#include "gpu/storage_texels.h"
#include "gpu/vulkan_error.h"
#include "shared/features.h"

namespace importon::gpu {
namespace {

constexpr std::uint32_t kMaxPushConstantBytes = 128;  // the least that Vulkan promises
constexpr std::uint32_t kDefaultWorkgroupSize = 64;
constexpr std::uint32_t kWorkgroupSizeId = 0;  // of the specialization constant

/// The kernel's constants with the workgroup size among them.
struct Constants {
  std::vector<Specialization> values;
  std::uint32_t workgroupSize = 1;
};

Constants constantsOf(const KernelCode& code, std::span<const Specialization> specialization) {
  Constants constants{{specialization.begin(), specialization.end()}, code.workgroupSize};
  if (!code.hasWorkgroupConstant) return constants;
  const auto given = std::find_if(specialization.begin(), specialization.end(),
                                  [](const Specialization& s) { return s.id == kWorkgroupSizeId; });
  if (given != specialization.end()) {
    constants.workgroupSize = given->value;
  } else if (code.workgroupSize == 1) {
    constants.workgroupSize = kDefaultWorkgroupSize;
    constants.values.push_back({kWorkgroupSizeId, kDefaultWorkgroupSize});
  }
  return constants;
}

void checkLimits(const Limits& limits, const std::string& label, const KernelCode& code, std::uint32_t workgroupSize) {
  if (code.pushConstantBytes > kMaxPushConstantBytes) {
    throw std::logic_error("kernel '" + label + "' has " + std::to_string(code.pushConstantBytes) +
                           " bytes of push constants; " + std::to_string(kMaxPushConstantBytes) + " are allowed");
  }
  if (workgroupSize == 0 || workgroupSize > limits.maxWorkgroupSize) {
    throw DeviceError("kernel '" + label + "' needs workgroups of " + std::to_string(workgroupSize) +
                          ", but the device allows 1 to " + std::to_string(limits.maxWorkgroupSize),
                      label, "choose another --device");
  }
}

SetLayoutHandle createSetLayout(Device& device, const std::string& label, std::span<const KernelBuffer> buffers) {
  std::vector<VkDescriptorSetLayoutBinding> entries;
  for (const KernelBuffer& buffer : buffers) {
    entries.push_back(
        {buffer.slot, descriptorType(buffer.kind, device.limits()), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<std::uint32_t>(entries.size());
  info.pBindings = entries.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout), "create a descriptor layout", label);
  return {device.handle(), layout};
}

PipelineLayoutHandle createPipelineLayout(Device& device, const std::string& label, VkDescriptorSetLayout set,
                                          std::uint32_t pushConstantBytes) {
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushConstantBytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = pushConstantBytes > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout), "create a pipeline layout", label);
  return {device.handle(), layout};
}

/// CPU time of this thread: others may have the cores.
double threadMilliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// The words to give to a driver: of the lean module where every rare constant is 0, or of that for placed meshes where
/// all others are.
std::span<const std::uint32_t> moduleFor(const KernelCode& code, std::span<const Specialization> constants) {
  const auto isZero = [&](std::uint32_t id) {
    return std::ranges::any_of(constants, [id](const Specialization& s) { return s.id == id && s.value == 0; });
  };
  if (!code.lean().empty() && std::ranges::all_of(code.rare, isZero)) return code.lean();
  const auto isNotAsked = [&](std::uint32_t id) { return id == kSpecHasInstances || isZero(id); };
  return !code.placed().empty() && std::ranges::all_of(code.rare, isNotAsked) ? code.placed() : code.spirv();
}

ShaderModuleHandle createModule(Device& device, const std::string& label, std::span<const std::uint32_t> spirv) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device.handle(), &info, nullptr, &module), "load kernel", label);
  return {device.handle(), module};
}

PipelineHandle createPipeline(Device& device, const std::string& label, VkShaderModule module, VkPipelineLayout layout,
                              std::span<const Specialization> constants) {
  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const auto offset = static_cast<std::uint32_t>(i * sizeof(Specialization) + offsetof(Specialization, value));
    entries.push_back({constants[i].id, offset, sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                            constants.size_bytes(), constants.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info, nullptr, &pipeline),
        "compile kernel", label);
  device.setDebugName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline), label);
  return {device.handle(), pipeline};
}

}  // namespace

VkDescriptorType descriptorType(BufferKind kind, const Limits& limits) {
  switch (kind) {
    case BufferKind::uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BufferKind::texels:
      if (limits.hasLargeTexelBuffers) return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
      break;
    case BufferKind::storage:
      break;
  }
  return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

Kernel::Kernel(Context& context, std::string label, const KernelCode& code,
               std::span<const Specialization> specialization)
    : impl_(std::make_unique<Impl>()), label_(std::move(label)) {
  Constants constants = constantsOf(code, specialization);
  checkLimits(context.limits(), label_, code, constants.workgroupSize);
  impl_->device = context.impl().device;
  Device& device = *impl_->device;
  impl_->code = &code;
  impl_->workgroupSize = constants.workgroupSize;
  impl_->setLayout = createSetLayout(device, label_, code.buffers);
  impl_->pipelineLayout = createPipelineLayout(device, label_, impl_->setLayout.get(), code.pushConstantBytes);
  impl_->constants = std::move(constants.values);
}

void Kernel::compile() const {
  std::call_once(impl_->compiles, [this] {
    const double start = threadMilliseconds();
    Device& device = *impl_->device;
    std::vector<std::uint32_t> module = specialised(moduleFor(*impl_->code, impl_->constants), impl_->constants);
    if (!device.limits().roundsDivision) module = roundedDivision(module);
    if (!device.limits().hasLargeTexelBuffers) module = storageTexels(module, impl_->code->buffers);
    const ShaderModuleHandle shader = createModule(device, label_, module);
    impl_->pipeline = createPipeline(device, label_, shader.get(), impl_->pipelineLayout.get(), impl_->constants);
    impl_->compileMilliseconds = threadMilliseconds() - start;
  });
}

Kernel::Kernel() = default;
Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;

double Kernel::compileMilliseconds() const { return impl_->compileMilliseconds; }
std::uint32_t Kernel::workgroupSize() const { return impl_->workgroupSize; }

}  // namespace importon::gpu
