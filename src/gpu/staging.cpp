#include "gpu/staging.h"

#include <algorithm>
#include <cstring>

#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

constexpr std::uint64_t kStagingBytes = 16u << 20;

}  // namespace

Staging::Staging(Device& device) : device_(device) {
  createBuffer();
  commandPool_ = createCommandPool(device);
  commands_ = allocateCommandBuffer(device, commandPool_.get());
  fence_ = createFence(device);
}

Staging::~Staging() = default;

void Staging::createBuffer() {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = kStagingBytes;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device_.handle(), &info, nullptr, &buffer), "create a buffer", "staging");
  buffer_ = {device_.handle(), buffer};
  device_.setDebugName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer), "staging");

  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device_.handle(), buffer, &needs);
  VkMemoryAllocateInfo allocation{};
  allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocation.allocationSize = needs.size;
  allocation.memoryTypeIndex =
      device_.facts()
          .memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                      VK_MEMORY_PROPERTY_HOST_CACHED_BIT)
          .value();  // Vulkan promises that there is one
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_.handle(), &allocation, nullptr, &memory), "allocate memory", "staging");
  memory_ = {device_.handle(), memory};
  check(vkBindBufferMemory(device_.handle(), buffer, memory, 0), "bind memory", "staging");
  void* mapped = nullptr;
  check(vkMapMemory(device_.handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped), "map memory", "staging");
  mapped_ = static_cast<std::byte*>(mapped);
}

template <class Record>
void Staging::submit(const Record& record) {
  beginCommands(device_, commands_);
  record();
  recordBarrier(commands_);
  check(vkEndCommandBuffer(commands_), "record a transfer", "staging");
  check(device_.submitAndWait(commands_, fence_.get()), "transfer a buffer", "staging");
}

void Staging::copy(VkBuffer from, std::uint64_t fromOffset, VkBuffer to, std::uint64_t toOffset, std::uint64_t bytes) {
  const VkBufferCopy region{fromOffset, toOffset, bytes};
  submit([&] { vkCmdCopyBuffer(commands_, from, to, 1, &region); });
}

void Staging::clear(VkBuffer buffer) {
  const std::lock_guard lock(mutex_);
  submit([&] { vkCmdFillBuffer(commands_, buffer, 0, VK_WHOLE_SIZE, 0); });
}

void Staging::upload(VkBuffer to, std::uint64_t offset, std::span<const std::byte> data) {
  const std::lock_guard lock(mutex_);
  for (std::uint64_t done = 0; done < data.size();) {
    const std::uint64_t bytes = std::min<std::uint64_t>(kStagingBytes, data.size() - done);
    std::memcpy(mapped_, data.data() + done, bytes);
    copy(buffer_.get(), 0, to, offset + done, bytes);
    done += bytes;
  }
}

void Staging::download(VkBuffer from, std::uint64_t offset, std::span<std::byte> data) {
  const std::lock_guard lock(mutex_);
  for (std::uint64_t done = 0; done < data.size();) {
    const std::uint64_t bytes = std::min<std::uint64_t>(kStagingBytes, data.size() - done);
    copy(from, offset + done, buffer_.get(), 0, bytes);
    std::memcpy(data.data() + done, mapped_, bytes);
    done += bytes;
  }
}

}  // namespace importon::gpu
