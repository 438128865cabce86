/// The validation layer and what it says.
#pragma once
#include <vulkan/vulkan.h>

#include <mutex>
#include <string>
#include <vector>

namespace importon::gpu {

inline constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

/// Collects warnings and errors; Vulkan calls may come from several threads.
class ValidationLog {
 public:
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

/// Throws DeviceError, naming the package to install, if the validation layer is not there.
void requireValidationLayer();

/// A messenger that writes to `log`, which must outlive the instance.
[[nodiscard]] VkDebugUtilsMessengerCreateInfoEXT messengerInfo(ValidationLog& log);

}  // namespace importon::gpu
