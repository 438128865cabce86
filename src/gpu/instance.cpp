#include "gpu/instance.h"

#include <array>

#include "base/error.h"
#include "gpu/device_choice.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

/// The function of an extension of the instance; null: not there.
template <class Function>
Function extensionFunction(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

VkInstance createInstance(bool hasValidation, ValidationLog& log) {
  if (hasValidation) requireValidationLayer();
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "importon";
  application.apiVersion = VK_API_VERSION_1_2;

  auto messenger = messengerInfo(log);
  constexpr std::array kEnabled = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = static_cast<std::uint32_t>(kEnabled.size());
  features.pEnabledValidationFeatures = kEnabled.data();
  const char* const layer = kValidationLayer;
  const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;

  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (hasValidation) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw DeviceError("no Vulkan driver was found", "", kInstallDriver);
  check(result, "create a Vulkan instance", "");
  return instance;
}

}  // namespace

Instance::Instance(bool hasValidation) : instance_(createInstance(hasValidation, validationLog_)) {
  if (hasValidation) listen();
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    extensionFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
        instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

void Instance::listen() {
  setObjectName_ = extensionFunction<PFN_vkSetDebugUtilsObjectNameEXT>(instance_, "vkSetDebugUtilsObjectNameEXT");
  const auto info = messengerInfo(validationLog_);
  const VkResult result = extensionFunction<PFN_vkCreateDebugUtilsMessengerEXT>(
      instance_, "vkCreateDebugUtilsMessengerEXT")(instance_, &info, nullptr, &messenger_);
  if (result == VK_SUCCESS) return;
  vkDestroyInstance(instance_, nullptr);
  check(result, "listen to the validation layer", kValidationLayer);
}

void Instance::setDebugName(VkDevice device, VkObjectType type, std::uint64_t object, const std::string& name) const {
  if (setObjectName_ == nullptr) return;
  VkDebugUtilsObjectNameInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
  info.objectType = type;
  info.objectHandle = object;
  info.pObjectName = name.c_str();
  check(setObjectName_(device, &info), "name an object", name);
}

}  // namespace importon::gpu
