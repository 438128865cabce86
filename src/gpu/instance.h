/// An instance of Vulkan 1.2, and the validation that listens to it.
#pragma once
#include <vulkan/vulkan.h>

#include <string>

#include "gpu/validation.h"

namespace importon::gpu {

class Instance {
 public:
  /// Throws DeviceError with a remedy when there is no driver, or no validation layer where it is wanted.
  explicit Instance(bool hasValidation);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance handle() const { return instance_; }
  [[nodiscard]] ValidationLog& validationLog() { return validationLog_; }

  /// Shows in validation messages and captures; does nothing without validation.
  void setDebugName(VkDevice device, VkObjectType type, std::uint64_t object, const std::string& name) const;

 private:
  void listen();

  ValidationLog validationLog_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  PFN_vkSetDebugUtilsObjectNameEXT setObjectName_ = nullptr;
};

}  // namespace importon::gpu
