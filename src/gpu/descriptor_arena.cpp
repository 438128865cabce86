#include "gpu/descriptor_arena.h"

#include <stdexcept>

#include "base/error.h"
#include "gpu/buffer_impl.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

constexpr std::uint32_t kSetsPerPool = 512;
constexpr std::array<std::uint32_t, 3> kDescriptorsPerPool = {kSetsPerPool * 12, kSetsPerPool * 2,
                                                              kSetsPerPool * 12};  // by BufferKind

std::string placeOf(const Kernel& kernel, const KernelBuffer& declared) {
  return "kernel '" + kernel.label() + "', buffer '" + std::string(declared.name) + "'";
}

void checkBuffer(const Kernel& kernel, const KernelBuffer& declared, const Buffer* buffer, const Limits& limits) {
  if (buffer == nullptr || !*buffer) throw std::logic_error(placeOf(kernel, declared) + ": there is none");
  if (declared.kind == BufferKind::texels && texelWords(buffer->texels()) != declared.texelWords) {
    throw std::logic_error(placeOf(kernel, declared) + ": texels of " + std::to_string(declared.texelWords) +
                           " words are wanted, those of '" + buffer->name() + "' have " +
                           std::to_string(texelWords(buffer->texels())));
  }
  const bool isRange = descriptorType(declared.kind, limits) == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  if (isRange && buffer->bytes() > limits.maxStorageBufferRange) {
    throw DeviceError("buffer '" + buffer->name() + "' of " + std::to_string(buffer->bytes()) +
                          " bytes is larger than a kernel can bind on this device (maxStorageBufferRange " +
                          std::to_string(limits.maxStorageBufferRange) + ")",
                      placeOf(kernel, declared),
                      "lower --memory, --photons or the image size, or choose another --device");
  }
}

}  // namespace

VkDescriptorSet DescriptorArena::bind(const Kernel& kernel, std::span<const Buffer* const> buffers) {
  const std::span<const KernelBuffer> declared = kernel.impl().code->buffers;
  if (buffers.size() != declared.size()) {
    throw std::logic_error("kernel '" + kernel.label() + "' takes " + std::to_string(declared.size()) +
                           " buffers, not " + std::to_string(buffers.size()));
  }
  std::vector<VkDescriptorBufferInfo> infos(declared.size());
  std::vector<VkBufferView> views(declared.size());
  std::vector<VkWriteDescriptorSet> writes(declared.size());
  for (std::size_t i = 0; i < declared.size(); ++i) {
    checkBuffer(kernel, declared[i], buffers[i], device_.limits());
    infos[i] = {buffers[i]->impl().buffer.get(), 0, buffers[i]->bytes()};
    views[i] = buffers[i]->impl().view.get();
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstBinding = declared[i].slot;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = descriptorType(declared[i].kind, device_.limits());
    writes[i].pBufferInfo = &infos[i];
    writes[i].pTexelBufferView = &views[i];
  }
  const VkDescriptorSet set = allocate(kernel);
  for (VkWriteDescriptorSet& write : writes) write.dstSet = set;
  vkUpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
  return set;
}

VkDescriptorSet DescriptorArena::allocate(const Kernel& kernel) {
  Use need{1, {}};
  for (const KernelBuffer& buffer : kernel.impl().code->buffers)
    ++need.descriptors[static_cast<std::size_t>(buffer.kind)];
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
    sizes[i] = {descriptorType(static_cast<BufferKind>(i), device_.limits()), kDescriptorsPerPool[i]};
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
