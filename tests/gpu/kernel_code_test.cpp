// What is found of a module when it is built.
#include "gpu/kernel_code.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "kernels/registry.h"
#include "shared/features.h"
#include "test_kernels/constants.h"
#include "test_kernels/fixed_workgroup.h"
#include "test_kernels/registry.h"
#include "test_kernels/shift_add.h"
#include "test_kernels/texels.h"
#include "test_kernels/unused_binding.h"

namespace importon::gpu {
namespace {

TEST(KernelCode, HasBuffersWithTheirKinds) {
  const std::span<const KernelBuffer> buffers = test_kernels::Texels::kCode.buffers;
  ASSERT_EQ(buffers.size(), 3u);
  EXPECT_EQ(buffers[0].slot, 0u);
  EXPECT_EQ(buffers[0].kind, BufferKind::texels);
  EXPECT_EQ(buffers[0].name, "whole");
  EXPECT_EQ(buffers[1].kind, BufferKind::storage);
  EXPECT_EQ(buffers[1].name, "out");
  EXPECT_EQ(buffers[2].kind, BufferKind::texels);
}

TEST(KernelCode, LeavesOutBuffersThatNoCodeUses) {
  const std::span<const KernelBuffer> buffers = test_kernels::UnusedBinding::kCode.buffers;
  ASSERT_EQ(buffers.size(), 3u);
  EXPECT_EQ(buffers[0].slot, 1u);
  EXPECT_EQ(buffers[1].slot, 3u);
  EXPECT_EQ(buffers[2].slot, 4u);
  EXPECT_EQ(buffers[2].kind, BufferKind::uniform);
}

TEST(KernelCode, HasPushConstants) {
  EXPECT_EQ(test_kernels::ShiftAdd::kCode.pushConstantBytes, 8u);
  EXPECT_EQ(sizeof(test_kernels::ShiftAdd::Push), 8u);
  EXPECT_EQ(test_kernels::Constants::kCode.pushConstantBytes, 0u);
  EXPECT_TRUE(std::is_empty_v<test_kernels::Constants::Push>);
}

TEST(KernelCode, HasTheWorkgroupSize) {
  EXPECT_TRUE(test_kernels::Constants::kCode.hasWorkgroupConstant);
  EXPECT_EQ(test_kernels::Constants::kCode.workgroupSize, 1u);
  EXPECT_EQ(test_kernels::FixedWorkgroup::kCode.workgroupSize, 128u);
  EXPECT_FALSE(test_kernels::code("needs_int64").hasWorkgroupConstant);
  EXPECT_EQ(test_kernels::code("needs_int64").workgroupSize, 1u);
}

TEST(KernelCode, BuffersComeFromTheFirstOwnerThatHasThem) {
  struct Owner {
    Buffer in, out;
  };
  const Owner first, second;
  const Buffer other;
  using test_kernels::ShiftAdd;
  EXPECT_EQ(ShiftAdd::buffers(first, second), (std::array{&first.in, &first.out}));
  EXPECT_EQ(ShiftAdd::buffers(test_kernels::buffers::Out{other}, second), (std::array{&second.in, &other}));
}

TEST(KernelCode, HasALeanModuleWhereFeaturesAreRare) {
  const KernelCode& code = test_kernels::code("rare");
  EXPECT_EQ(std::vector(code.rare.begin(), code.rare.end()),
            (std::vector<std::uint32_t>{kSpecHasSheen, kSpecHasDispersion}));
  ASSERT_FALSE(code.lean().empty());
  EXPECT_LT(code.lean().size(), code.spirv().size());
  EXPECT_TRUE(test_kernels::code("constants").lean().empty());
  EXPECT_TRUE(test_kernels::code("constants").rare.empty());
}

TEST(KernelCode, HasAModuleOfItsOwnForPlacedMeshes) {
  EXPECT_TRUE(test_kernels::code("rare").placed().empty());
  const KernelCode& code = kernels::code("eye_scatter");
  EXPECT_LT(code.lean().size(), code.placed().size());
  EXPECT_LT(code.placed().size(), code.spirv().size());
}

TEST(KernelCode, EveryKernelHasAModuleAndSlotsOfItsOwn) {
  for (const std::span<const KernelCode* const> all : {kernels::all(), test_kernels::all()}) {
    for (const KernelCode* code : all) {
      SCOPED_TRACE(code->name);
      ASSERT_FALSE(code->spirv().empty());
      EXPECT_EQ(code->spirv()[0], 0x07230203u);
      EXPECT_LE(code->pushConstantBytes, 128u);
      std::set<std::uint32_t> slots;
      for (const KernelBuffer& buffer : code->buffers) EXPECT_TRUE(slots.insert(buffer.slot).second) << buffer.name;
    }
  }
}

}  // namespace
}  // namespace importon::gpu
