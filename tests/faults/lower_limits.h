/// Limits of a device lowered to what Vulkan 1.2 promises. IMPORTON_TEST_LIMITS names them, apart by commas, or `all`:
/// texels, ranges, workgroups, shared, allocations, timestamps, driver (one that nobody knows, so that its arithmetic
/// is not trusted), descriptors. `all` leaves out the driver, whose kernels take long to compile, and descriptors, of
/// which kernels need more than is promised.
#pragma once
#include <vulkan/vulkan.h>

namespace importon::test {

void lowerLimits(VkPhysicalDeviceLimits& limits);
void lowerLimits(VkPhysicalDeviceMaintenance3Properties& properties);
void lowerLimits(VkPhysicalDeviceDriverProperties& properties);
void lowerLimits(VkQueueFamilyProperties& family);

}  // namespace importon::test
