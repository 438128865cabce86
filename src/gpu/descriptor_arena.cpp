#include "gpu/descriptor_arena.h"

#include <stdexcept>

#include "base/error.h"
#include "gpu/buffer_impl.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

constexpr std::uint32_t kSetsPerPool = 512;
constexpr std::array<std::uint32_t, 3> kDescriptorsPerPool = {kSetsPerPool * 12, kSetsPerPool * 2,
                                                              kSetsPerPool * 12};  // by BindingKind

std::string slotOf(const Kernel& kernel, const ReflectedBinding& binding) {
  return "kernel '" + kernel.label() + "', slot " + std::to_string(binding.slot) + " (" + binding.name + ")";
}

const Buffer& bufferFor(const Kernel& kernel, const ReflectedBinding& binding, const BindingTable& table,
                        const Limits& limits) {
  const Buffer* buffer = table.get(binding.slot);
  if (buffer == nullptr || !*buffer) throw std::logic_error(slotOf(kernel, binding) + ": no buffer is bound");
  if (binding.kind == BindingKind::uniformTexelBuffer && !buffer->impl().view) {
    throw std::logic_error(slotOf(kernel, binding) + ": buffer '" + buffer->name() + "' has no texel format");
  }
  if (binding.kind == BindingKind::storageBuffer && buffer->bytes() > limits.maxStorageBufferRange) {
    throw DeviceError("buffer '" + buffer->name() + "' of " + std::to_string(buffer->bytes()) +
                          " bytes is larger than a kernel can bind on this device (maxStorageBufferRange " +
                          std::to_string(limits.maxStorageBufferRange) + ")",
                      slotOf(kernel, binding),
                      "lower --memory, --photons or the image size, or choose another --device");
  }
  return *buffer;
}

}  // namespace

VkDescriptorSet DescriptorArena::bind(const Kernel& kernel, const BindingTable& table) {
  const std::vector<ReflectedBinding>& bindings = kernel.impl().bindings;
  std::vector<VkDescriptorBufferInfo> buffers(bindings.size());
  std::vector<VkBufferView> views(bindings.size());
  std::vector<VkWriteDescriptorSet> writes(bindings.size());
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    const Buffer& buffer = bufferFor(kernel, bindings[i], table, device_.limits());
    buffers[i] = {buffer.impl().buffer.get(), 0, buffer.bytes()};
    views[i] = buffer.impl().view.get();
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstBinding = bindings[i].slot;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = descriptorType(bindings[i].kind);
    writes[i].pBufferInfo = &buffers[i];
    writes[i].pTexelBufferView = &views[i];
  }
  const VkDescriptorSet set = allocate(kernel);
  for (VkWriteDescriptorSet& write : writes) write.dstSet = set;
  vkUpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
  return set;
}

VkDescriptorSet DescriptorArena::allocate(const Kernel& kernel) {
  Use need{1, {}};
  for (const ReflectedBinding& binding : kernel.impl().bindings)
    ++need.descriptors[static_cast<std::size_t>(binding.kind)];
  bool isFull = pools_.empty() || use_.sets + need.sets > kSetsPerPool;
  for (std::size_t i = 0; i < 3; ++i) isFull |= use_.descriptors[i] + need.descriptors[i] > kDescriptorsPerPool[i];
  if (isFull) {
    if (!pools_.empty()) ++current_;
    if (current_ == pools_.size()) addPool();
    use_ = {};
  }
  use_.sets += need.sets;
  for (std::size_t i = 0; i < 3; ++i) use_.descriptors[i] += need.descriptors[i];

  const VkDescriptorSetLayout layout = kernel.impl().setLayout.get();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pools_[current_].get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device_.handle(), &info, &set), "allocate a descriptor set", kernel.label());
  return set;
}

void DescriptorArena::addPool() {
  std::array<VkDescriptorPoolSize, 3> sizes{};
  for (std::size_t i = 0; i < 3; ++i) {
    sizes[i] = {descriptorType(static_cast<BindingKind>(i)), kDescriptorsPerPool[i]};
  }
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = kSetsPerPool;
  info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool), "create a descriptor pool",
        device_.info().name);
  pools_.emplace_back(device_.handle(), pool);
}

void DescriptorArena::reset() {
  for (const DescriptorPoolHandle& pool : pools_) {
    check(vkResetDescriptorPool(device_.handle(), pool.get(), 0), "reset a descriptor pool", device_.info().name);
  }
  current_ = 0;
  use_ = {};
}

}  // namespace importon::gpu
