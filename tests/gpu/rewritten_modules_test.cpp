// Modules that are rewritten for a device, whose texel buffers are read as storage buffers, and whose quotients and
// roots are rounded: valid, and without anything that such a device lacks. That they compute the same bits is a test of
// whole renders (DeviceLimits).

#include <gtest/gtest.h>

#include <algorithm>
#include <glslang/SPIRV/spirv.hpp>
#include <spirv-tools/libspirv.hpp>
#include <stdexcept>

#include "gpu/rounded_division.h"
#include "gpu/storage_texels.h"
#include "kernels/registry.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

std::size_t countOf(std::span<const std::uint32_t> module, spv::Op operation) {
  constexpr std::size_t kHeaderWords = 5;
  std::size_t count = 0;
  for (std::size_t at = kHeaderWords; at < module.size(); at += std::max(module[at] >> spv::WordCountShift, 1u))
    count += (module[at] & spv::OpCodeMask) == operation ? 1 : 0;
  return count;
}

bool isValid(const Words& module) {
  spvtools::ValidatorOptions layout;
  layout.SetScalarBlockLayout(true);
  return spvtools::SpirvTools(SPV_ENV_VULKAN_1_2).Validate(module.data(), module.size(), layout);
}

TEST(StorageTexels, EveryModuleOfEveryKernelIsValidAndHasNoTexelBuffer) {
  std::size_t fetches = 0;
  for (const KernelCode* code : kernels::all()) {
    for (const auto module : {code->spirv(), code->lean(), code->placed()}) {
      if (module.empty()) continue;
      const Words rewritten = storageTexels(module, code->buffers);
      EXPECT_TRUE(isValid(rewritten)) << code->name;
      for (const spv::Op left : {spv::OpTypeImage, spv::OpTypeSampledImage, spv::OpImage, spv::OpImageFetch})
        EXPECT_EQ(countOf(rewritten, left), 0u) << code->name << ": operation " << left;
      fetches += countOf(module, spv::OpImageFetch);
    }
  }
  EXPECT_GT(fetches, 1000u);
}

TEST(StorageTexels, AModuleWithoutTexelBuffersStaysAsItIs) {
  const KernelCode& code = test_kernels::code("shift_add");
  EXPECT_TRUE(std::ranges::equal(storageTexels(code.spirv(), code.buffers), code.spirv()));
}

TEST(StorageTexels, ATexelBufferThatIsNotDescribedIsAnError) {
  EXPECT_THROW((void)storageTexels(test_kernels::code("texels").spirv(), {}), std::logic_error);
}

TEST(RoundedDivision, EveryKernelIsValidAndDividesInTheFunctionsAlone) {
  std::size_t quotients = 0;
  for (const KernelCode* code : kernels::all()) {
    const Words rewritten = roundedDivision(code->spirv());
    EXPECT_TRUE(isValid(rewritten)) << code->name;
    EXPECT_EQ(countOf(rewritten, spv::OpFDiv), 2u) << code->name;  // one of significands, one of what is not normal
    quotients += countOf(code->spirv(), spv::OpFDiv);
  }
  EXPECT_GT(quotients, 500u);
}

}  // namespace
}  // namespace importon::gpu
