// A Vulkan layer that lets a device fail on demand, for tests of how a program ends then. IMPORTON_TEST_FAULT:
//   lost N        the N-th submission, and all after it, find the device lost
//   lost N DEVICE the same of the device of this index alone, of its own submissions
//   memory MIB    allocations fail once so much is in use
//   heap MIB      the device says that it has no more memory than that
//   pipelines N   its pipeline cache has N bytes to keep, and standard error tells when they are given back
// IMPORTON_TEST_LIMITS: see lower_limits.h.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "lower_limits.h"

namespace {

struct Fault {
  std::string kind;
  std::uint64_t limit = 0;
  std::optional<std::size_t> device;  // index; none: of all of them
};

const Fault& fault() {
  static const Fault kRead = [] {
    const char* const text = std::getenv("IMPORTON_TEST_FAULT");
    std::istringstream words(text == nullptr ? "none 0" : text);
    Fault fault;
    std::size_t device = 0;
    words >> fault.kind >> fault.limit;
    if (words >> device) fault.device = device;
    return fault;
  }();
  return kRead;
}

/// Of an instance; physical devices lead to it. Asked for later, the loader names this layer's own functions.
struct InstanceCalls {
  VkInstance handle = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr proc = nullptr;
  PFN_vkEnumeratePhysicalDevices enumerate = nullptr;
  PFN_vkGetPhysicalDeviceMemoryProperties memoryProperties = nullptr;
  PFN_vkGetPhysicalDeviceProperties properties = nullptr;
  PFN_vkGetPhysicalDeviceProperties2 properties2 = nullptr;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties queueFamilies = nullptr;
};

/// Of a device; queues lead to it.
struct DeviceCalls {
  VkDevice handle = VK_NULL_HANDLE;
  PFN_vkGetDeviceProcAddr proc = nullptr;
  bool canBeLost = false;
  std::uint64_t submissions = 0;

  template <class Function>
  Function next(const char* name) const {
    return reinterpret_cast<Function>(proc(handle, name));
  }
};

std::mutex mutex;
std::map<void*, InstanceCalls> instances;
std::map<void*, DeviceCalls> devices;
std::map<VkDeviceMemory, std::uint64_t> allocations;  // bytes
std::uint64_t bytesInUse = 0;

/// What all objects of an instance, or of a device, begin with.
void* keyOf(const void* object) { return *static_cast<void* const*>(object); }

InstanceCalls& instanceOf(const void* object) {
  const std::lock_guard lock(mutex);
  return instances[keyOf(object)];
}

DeviceCalls& deviceOf(const void* object) {
  const std::lock_guard lock(mutex);
  return devices[keyOf(object)];
}

/// True for a device that the fault is of.
bool canFail(const InstanceCalls& instance, VkPhysicalDevice physical) {
  if (!fault().device) return true;
  std::uint32_t count = 0;
  instance.enumerate(instance.handle, &count, nullptr);
  std::vector<VkPhysicalDevice> all(count);
  instance.enumerate(instance.handle, &count, all.data());
  return *fault().device < all.size() && all[*fault().device] == physical;
}

/// What the loader passes on to the layers: the link to the next one.
template <class Link>
Link* findLink(const void* chain, VkStructureType type) {
  for (auto* at = const_cast<Link*>(static_cast<const Link*>(chain)); at != nullptr;
       at = const_cast<Link*>(static_cast<const Link*>(at->pNext)))
    if (at->sType == type && at->function == VK_LAYER_LINK_INFO) return at;
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkInstance* created) {
  auto* const link = findLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  InstanceCalls calls;
  calls.proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(calls.proc(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, created);
  if (result != VK_SUCCESS) return result;
  calls.handle = *created;
  const auto ask = [&calls]<class Function>(Function& next, const char* name) {
    next = reinterpret_cast<Function>(calls.proc(calls.handle, name));
  };
  ask(calls.enumerate, "vkEnumeratePhysicalDevices");
  ask(calls.memoryProperties, "vkGetPhysicalDeviceMemoryProperties");
  ask(calls.properties, "vkGetPhysicalDeviceProperties");
  ask(calls.properties2, "vkGetPhysicalDeviceProperties2");
  ask(calls.queueFamilies, "vkGetPhysicalDeviceQueueFamilyProperties");
  instanceOf(*created) = calls;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* created) {
  auto* const link = findLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  const InstanceCalls& instance = instanceOf(physical);
  DeviceCalls calls{VK_NULL_HANDLE, link->u.pLayerInfo->pfnNextGetDeviceProcAddr, canFail(instance, physical)};
  const auto nextProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(nextProc(instance.handle, "vkCreateDevice"));
  const VkResult result = create(physical, info, allocator, created);
  if (result != VK_SUCCESS) return result;
  calls.handle = *created;
  deviceOf(*created) = calls;
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice destroyed, const VkAllocationCallbacks* allocator) {
  const auto destroy = deviceOf(destroyed).next<PFN_vkDestroyDevice>("vkDestroyDevice");
  destroy(destroyed, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                           VkFence fence) {
  DeviceCalls& device = deviceOf(queue);
  if (fault().kind == "lost" && device.canBeLost && ++device.submissions >= fault().limit) return VK_ERROR_DEVICE_LOST;
  return device.next<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice of, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
  const DeviceCalls& device = deviceOf(of);
  const std::lock_guard lock(mutex);
  if (fault().kind == "memory" && bytesInUse + info->allocationSize > fault().limit << 20)
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  const VkResult result = device.next<PFN_vkAllocateMemory>("vkAllocateMemory")(of, info, allocator, memory);
  if (result != VK_SUCCESS) return result;
  allocations[*memory] = info->allocationSize;
  bytesInUse += info->allocationSize;
  return result;
}

VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice of, VkDeviceMemory memory, const VkAllocationCallbacks* allocator) {
  const DeviceCalls& device = deviceOf(of);
  const std::lock_guard lock(mutex);
  bytesInUse -= allocations[memory];
  allocations.erase(memory);
  device.next<PFN_vkFreeMemory>("vkFreeMemory")(of, memory, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL createPipelineCache(VkDevice of, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks* allocator, VkPipelineCache* created) {
  VkPipelineCacheCreateInfo own = *info;
  if (fault().kind == "pipelines" && info->initialDataSize > fault().limit) {
    std::fprintf(stderr, "%zu bytes of pipelines\n", info->initialDataSize);
    own.initialDataSize -= fault().limit;
  }
  return deviceOf(of).next<PFN_vkCreatePipelineCache>("vkCreatePipelineCache")(of, &own, allocator, created);
}

VKAPI_ATTR VkResult VKAPI_CALL getPipelineCacheData(VkDevice of, VkPipelineCache cache, std::size_t* bytes,
                                                    void* data) {
  const auto get = deviceOf(of).next<PFN_vkGetPipelineCacheData>("vkGetPipelineCacheData");
  if (fault().kind != "pipelines") return get(of, cache, bytes, data);
  std::size_t own = data == nullptr ? 0 : *bytes - fault().limit;
  const VkResult result = get(of, cache, &own, data);
  if (data != nullptr) std::memset(static_cast<char*>(data) + own, 'p', fault().limit);
  *bytes = own + fault().limit;
  return result;
}

VKAPI_ATTR void VKAPI_CALL getMemoryProperties(VkPhysicalDevice physical,
                                               VkPhysicalDeviceMemoryProperties* properties) {
  instanceOf(physical).memoryProperties(physical, properties);
  if (fault().kind != "heap") return;
  for (std::uint32_t i = 0; i < properties->memoryHeapCount; ++i)
    properties->memoryHeaps[i].size = std::min<VkDeviceSize>(properties->memoryHeaps[i].size, fault().limit << 20);
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties) {
  instanceOf(physical).properties(physical, properties);
  importon::test::lowerLimits(properties->limits);
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties) {
  instanceOf(physical).properties2(physical, properties);
  importon::test::lowerLimits(properties->properties.limits);
  for (auto* at = static_cast<VkBaseOutStructure*>(properties->pNext); at != nullptr; at = at->pNext) {
    if (at->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES)
      importon::test::lowerLimits(*reinterpret_cast<VkPhysicalDeviceMaintenance3Properties*>(at));
    if (at->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES)
      importon::test::lowerLimits(*reinterpret_cast<VkPhysicalDeviceDriverProperties*>(at));
  }
}

VKAPI_ATTR void VKAPI_CALL getQueueFamilies(VkPhysicalDevice physical, std::uint32_t* count,
                                            VkQueueFamilyProperties* families) {
  instanceOf(physical).queueFamilies(physical, count, families);
  for (std::uint32_t i = 0; families != nullptr && i < *count; ++i) importon::test::lowerLimits(families[i]);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice of, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance of, const char* name);

PFN_vkVoidFunction ownProc(const char* name) {
  static const std::map<std::string, PFN_vkVoidFunction> kFunctions = {
      {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(createInstance)},
      {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(createDevice)},
      {"vkDestroyDevice", reinterpret_cast<PFN_vkVoidFunction>(destroyDevice)},
      {"vkQueueSubmit", reinterpret_cast<PFN_vkVoidFunction>(queueSubmit)},
      {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(allocateMemory)},
      {"vkFreeMemory", reinterpret_cast<PFN_vkVoidFunction>(freeMemory)},
      {"vkCreatePipelineCache", reinterpret_cast<PFN_vkVoidFunction>(createPipelineCache)},
      {"vkGetPipelineCacheData", reinterpret_cast<PFN_vkVoidFunction>(getPipelineCacheData)},
      {"vkGetPhysicalDeviceMemoryProperties", reinterpret_cast<PFN_vkVoidFunction>(getMemoryProperties)},
      {"vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(getProperties)},
      {"vkGetPhysicalDeviceProperties2", reinterpret_cast<PFN_vkVoidFunction>(getProperties2)},
      {"vkGetPhysicalDeviceQueueFamilyProperties", reinterpret_cast<PFN_vkVoidFunction>(getQueueFamilies)},
      {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(deviceProc)},
      {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(instanceProc)},
  };
  const auto found = kFunctions.find(name);
  return found == kFunctions.end() ? nullptr : found->second;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice of, const char* name) {
  const PFN_vkVoidFunction own = ownProc(name);
  return own != nullptr ? own : deviceOf(of).proc(of, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance of, const char* name) {
  const PFN_vkVoidFunction own = ownProc(name);
  return own != nullptr || of == VK_NULL_HANDLE ? own : instanceOf(of).proc(of, name);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* interface) {
  interface->loaderLayerInterfaceVersion = 2;
  interface->pfnGetInstanceProcAddr = instanceProc;
  interface->pfnGetDeviceProcAddr = deviceProc;
  interface->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
