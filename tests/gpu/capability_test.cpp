// What kernels ask of a device beyond Vulkan 1.2 with scalar block layout: nothing, so that subgroup size, 64-bit
// integers and atomics of any kind cannot matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <glslang/SPIRV/spirv.hpp>
#include <set>

#include "kernels/registry.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

/// Capabilities that a module declares [SPIR-V specification, 2.3 and 3.42.8].
std::set<std::uint32_t> capabilitiesOf(std::span<const std::uint32_t> spirv) {
  constexpr std::size_t kHeaderWords = 5;
  std::set<std::uint32_t> capabilities;
  for (std::size_t at = kHeaderWords; at < spirv.size(); at += std::max(spirv[at] >> spv::WordCountShift, 1u))
    if ((spirv[at] & spv::OpCodeMask) == spv::OpCapability) capabilities.insert(spirv[at + 1]);
  return capabilities;
}

TEST(Capabilities, OfKernelsAreThoseOfEveryDevice) {
  const std::set<std::uint32_t> everywhere = {spv::CapabilityShader, spv::CapabilitySampledBuffer,
                                              spv::CapabilityImageQuery};
  for (const KernelCode* code : kernels::all())
    for (const std::uint32_t capability : capabilitiesOf(code->spirv()))
      EXPECT_TRUE(everywhere.contains(capability)) << code->name << " declares capability " << capability;
}

TEST(Capabilities, NoKernelBindsMoreThanDevicesAreAskedFor) {
  MostDescriptors most{};
  for (const KernelCode* code : kernels::all()) {
    const auto count = [code](BufferKind kind) {
      return static_cast<std::uint32_t>(std::ranges::count(code->buffers, kind, &KernelBuffer::kind));
    };
    most.storage = std::max(most.storage, count(BufferKind::storage));
    most.texels = std::max(most.texels, count(BufferKind::texels));
    most.uniform = std::max(most.uniform, count(BufferKind::uniform));
    most.storageAndTexels = std::max(most.storageAndTexels, count(BufferKind::storage) + count(BufferKind::texels));
    EXPECT_LE(code->pushConstantBytes, 128u) << code->name;
  }
  EXPECT_EQ(most.storage, kMostDescriptors.storage);
  EXPECT_EQ(most.texels, kMostDescriptors.texels);
  EXPECT_EQ(most.uniform, kMostDescriptors.uniform);
  EXPECT_EQ(most.storageAndTexels, kMostDescriptors.storageAndTexels);
}

TEST(Capabilities, AreSeen) {
  EXPECT_TRUE(capabilitiesOf(test_kernels::code("needs_int64").spirv()).contains(spv::CapabilityInt64));
}

}  // namespace
}  // namespace importon::gpu
