/// Sole ownership of a Vulkan object.
#pragma once
#include <vulkan/vulkan.h>

#include <utility>

namespace importon::gpu {

/// Destroys `T` by `kDestroy(parent, object, nullptr)`. Empty by default.
template <class Parent, class T, auto kDestroy>
class Handle {
 public:
  Handle() = default;
  Handle(Parent parent, T object) : parent_(parent), object_(object) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : parent_(other.parent_), object_(std::exchange(other.object_, T{})) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      parent_ = other.parent_;
      object_ = std::exchange(other.object_, T{});
    }
    return *this;
  }

  [[nodiscard]] T get() const { return object_; }
  explicit operator bool() const { return object_ != T{}; }

 private:
  void reset() {
    if (object_ != T{}) kDestroy(parent_, object_, nullptr);
    object_ = T{};
  }

  Parent parent_{};
  T object_{};
};

using BufferHandle = Handle<VkDevice, VkBuffer, vkDestroyBuffer>;
using BufferViewHandle = Handle<VkDevice, VkBufferView, vkDestroyBufferView>;
using MemoryHandle = Handle<VkDevice, VkDeviceMemory, vkFreeMemory>;
using CommandPoolHandle = Handle<VkDevice, VkCommandPool, vkDestroyCommandPool>;
using FenceHandle = Handle<VkDevice, VkFence, vkDestroyFence>;
using QueryPoolHandle = Handle<VkDevice, VkQueryPool, vkDestroyQueryPool>;
using DescriptorPoolHandle = Handle<VkDevice, VkDescriptorPool, vkDestroyDescriptorPool>;
using SetLayoutHandle = Handle<VkDevice, VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using PipelineLayoutHandle = Handle<VkDevice, VkPipelineLayout, vkDestroyPipelineLayout>;
using PipelineHandle = Handle<VkDevice, VkPipeline, vkDestroyPipeline>;
using PipelineCacheHandle = Handle<VkDevice, VkPipelineCache, vkDestroyPipelineCache>;
using ShaderModuleHandle = Handle<VkDevice, VkShaderModule, vkDestroyShaderModule>;

}  // namespace importon::gpu
