// Preloaded by tests of batches: counts what a program asks the Vulkan loader for, and loses the device once.
//   IMPORTON_TEST_LOST_AT N     the N-th submission finds the device lost, those after it do not
//   IMPORTON_TEST_LOST_FROM N   those after it do too
//   IMPORTON_TEST_COUNTS FILE   at the end takes "DEVICES PIPELINES SUBMISSIONS", how many there were
#include <dlfcn.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

struct Counts {
  std::atomic<unsigned> submissions{0}, devices{0}, pipelines{0};
  ~Counts() {
    const char* const name = std::getenv("IMPORTON_TEST_COUNTS");
    std::FILE* const file = name == nullptr ? nullptr : std::fopen(name, "w");
    if (file == nullptr) return;
    std::fprintf(file, "%u %u %u\n", devices.load(), pipelines.load(), submissions.load());
    std::fclose(file);
  }
};

Counts counts;

/// Of an environment variable; 0: it is not there.
unsigned long number(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::strtoul(text, nullptr, 10);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* submits,
                                             VkFence fence) {
  static const auto kReal = next<PFN_vkQueueSubmit>("vkQueueSubmit");
  const unsigned long at = ++counts.submissions, from = number("IMPORTON_TEST_LOST_FROM");
  if (at == number("IMPORTON_TEST_LOST_AT") || (from > 0 && at >= from)) return VK_ERROR_DEVICE_LOST;
  return kReal(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDevice* device) {
  static const auto kReal = next<PFN_vkCreateDevice>("vkCreateDevice");
  ++counts.devices;
  return kReal(physical, info, allocator, device);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateComputePipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                                        const VkComputePipelineCreateInfo* infos,
                                                        const VkAllocationCallbacks* allocator, VkPipeline* pipelines) {
  static const auto kReal = next<PFN_vkCreateComputePipelines>("vkCreateComputePipelines");
  counts.pipelines += count;
  return kReal(device, cache, count, infos, allocator, pipelines);
}

}  // extern "C"
