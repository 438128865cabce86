#include "gpu/buffer.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "base/error.h"
#include "gpu/buffer_impl.h"
#include "gpu/staging.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

struct TexelInfo {
  VkFormat format;
  std::uint64_t bytes;
};

TexelInfo texelInfo(TexelFormat texels) {
  switch (texels) {
    case TexelFormat::uint1:
      return {VK_FORMAT_R32_UINT, 4};
    case TexelFormat::uint2:
      return {VK_FORMAT_R32G32_UINT, 8};
    case TexelFormat::uint4:
      return {VK_FORMAT_R32G32B32A32_UINT, 16};
    case TexelFormat::float1:
      return {VK_FORMAT_R32_SFLOAT, 4};
    case TexelFormat::float2:
      return {VK_FORMAT_R32G32_SFLOAT, 8};
    case TexelFormat::float4:
      return {VK_FORMAT_R32G32B32A32_SFLOAT, 16};
    case TexelFormat::none:
      break;
  }
  return {VK_FORMAT_UNDEFINED, 4};
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; }

void refuse(const std::string& limitName, const std::string& need, const std::string& limit, const std::string& name) {
  throw DeviceError("buffer '" + name + "' needs " + need + ", but the device's " + limitName + " is " + limit, name,
                    "lower --memory or the image size, use a smaller scene, or choose another --device");
}

void checkLimits(const Limits& limits, const std::string& name, std::uint64_t bytes, TexelFormat texels) {
  const std::uint64_t most = std::min(limits.maxAllocation, limits.heapBytes);
  if (bytes > most) {
    refuse(limits.maxAllocation < limits.heapBytes ? "largest allocation" : "memory", mebibytes(bytes), mebibytes(most),
           name);
  }
  if (texels == TexelFormat::none || !limits.hasLargeTexelBuffers) return;
  const std::uint64_t elements = bytes / texelInfo(texels).bytes;
  if (elements > limits.maxTexelBufferElements) {
    refuse("maxTexelBufferElements", std::to_string(elements) + " texels",
           std::to_string(limits.maxTexelBufferElements), name);
  }
}

/// Bytes to give a texel buffer at the end. Mesa's CPU driver compiles a kernel anew for each pattern of texel buffers
/// whose sizes are powers of two, and of those that have bits 8 to 15 of it zero, which it takes for a number of mip
/// levels: none is, and none has.
std::uint64_t paddingOf(std::uint64_t bytes) {
  std::uint64_t padded = bytes;
  if (((padded >> 8) & 255) == 0) padded += 256;
  if (std::has_single_bit(padded)) padded += 16;
  return padded - bytes;
}

bool hasView(const Device& device, TexelFormat texels) {
  return texels != TexelFormat::none && device.limits().hasLargeTexelBuffers;
}

BufferHandle createBuffer(Device& device, const std::string& name, std::uint64_t bytes, TexelFormat texels) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (hasView(device, texels)) info.usage |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer), "create buffer '" + name + "'", device.info().name);
  device.setDebugName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer), name);
  return {device.handle(), buffer};
}

/// Asks for huge pages where host memory spans some: the system hands it out in fewer pieces.
void preferHugePages(void* memory, std::uint64_t bytes) {
  constexpr std::uintptr_t kHugePage = 2u << 20;
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kHugePage - 1) / kHugePage * kHugePage;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kHugePage * kHugePage;
  if (begin < end) (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // a wish
}

/// Device-local memory, mapped if the device maps its buffers.
void allocateMemory(Buffer::Impl& impl, const std::string& name) {
  Device& device = *impl.device;
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device.handle(), impl.buffer.get(), &needs);
  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  const auto type = device.facts().memoryType(needs.memoryTypeBits, device.facts().mapsBuffers ? kHost : 0,
                                              VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  if (!type)
    throw DeviceError("no memory type suits buffer '" + name + "'", device.info().name, "choose another --device");
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = *type;
  const std::string doing = "allocate " + mebibytes(needs.size) + " for buffer '" + name + "' besides " +
                            mebibytes(device.allocatedBytes()) + " in use, of " + mebibytes(device.limits().heapBytes);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.handle(), &info, nullptr, &memory), doing, device.info().name);
  impl.memory = {device.handle(), memory};
  impl.allocatedBytes = needs.size;
  device.countAllocation(needs.size);
  check(vkBindBufferMemory(device.handle(), impl.buffer.get(), memory, 0), doing, device.info().name);
  if (!device.facts().mapsBuffers) return;
  void* mapped = nullptr;
  check(vkMapMemory(device.handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped), doing, device.info().name);
  impl.mapped = static_cast<std::byte*>(mapped);
  if (device.limits().isCpu) preferHugePages(mapped, needs.size);
}

BufferViewHandle createView(Device& device, const std::string& name, VkBuffer buffer, TexelFormat texels) {
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = buffer;
  info.format = texelInfo(texels).format;
  info.range = VK_WHOLE_SIZE;
  VkBufferView view = VK_NULL_HANDLE;
  check(vkCreateBufferView(device.handle(), &info, nullptr, &view), "create a texel view of buffer '" + name + "'",
        device.info().name);
  return {device.handle(), view};
}

void checkRange(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes) {
  if (offset > buffer.bytes() || bytes > buffer.bytes() - offset) {
    throw std::logic_error("transfer of " + std::to_string(bytes) + " bytes at " + std::to_string(offset) +
                           " passes the end of buffer '" + buffer.name() + "' of " + std::to_string(buffer.bytes()) +
                           " bytes");
  }
}

}  // namespace

std::uint32_t texelWords(TexelFormat texels) {
  return texels == TexelFormat::none ? 0 : static_cast<std::uint32_t>(texelInfo(texels).bytes / 4);
}

Buffer::Buffer(Context& context, std::string name, std::uint64_t bytes, TexelFormat texels)
    : impl_(std::make_unique<Impl>()), name_(std::move(name)), texels_(texels) {
  const std::uint64_t texelBytes = texelInfo(texels).bytes;
  bytes_ = std::max((bytes + texelBytes - 1) / texelBytes * texelBytes, texelBytes);
  const std::uint64_t padded = texels == TexelFormat::none ? bytes_ : bytes_ + paddingOf(bytes_);
  checkLimits(context.limits(), name_, padded, texels);
  impl_->device = context.impl().device;
  impl_->buffer = createBuffer(*impl_->device, name_, padded, texels);
  allocateMemory(*impl_, name_);
  if (hasView(*impl_->device, texels)) impl_->view = createView(*impl_->device, name_, impl_->buffer.get(), texels);
}

Buffer::Buffer() = default;
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

std::uint64_t Buffer::allocatedBytes() const { return impl_ ? impl_->allocatedBytes : 0; }

void Buffer::uploadBytes(std::span<const std::byte> data, std::uint64_t offset) {
  checkRange(*this, offset, data.size());
  if (data.empty()) return;
  if (impl_->mapped != nullptr) {
    std::memcpy(impl_->mapped + offset, data.data(), data.size());
  } else {
    impl_->device->staging().upload(impl_->buffer.get(), offset, data);
  }
}

void Buffer::clear() {
  if (impl_->mapped != nullptr) {
    std::memset(impl_->mapped, 0, bytes_);
  } else {
    impl_->device->staging().clear(impl_->buffer.get());
  }
}

void Buffer::downloadBytes(std::span<std::byte> data, std::uint64_t offset) const {
  checkRange(*this, offset, data.size());
  if (data.empty()) return;
  if (impl_->mapped != nullptr) {
    std::memcpy(data.data(), impl_->mapped + offset, data.size());
  } else {
    impl_->device->staging().download(impl_->buffer.get(), offset, data);
  }
}

}  // namespace importon::gpu
