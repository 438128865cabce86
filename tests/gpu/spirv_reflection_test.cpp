#include "gpu/spirv_reflection.h"

#include <gtest/gtest.h>

#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

Reflection reflectKernel(std::string_view name) { return reflect(test_kernels::spirv(name)); }

TEST(SpirvReflection, FindsBindingsWithTheirKinds) {
  const Reflection module = reflectKernel("texels");
  ASSERT_EQ(module.bindings.size(), 3u);
  EXPECT_EQ(module.bindings[0].slot, 0u);
  EXPECT_EQ(module.bindings[0].kind, BindingKind::uniformTexelBuffer);
  EXPECT_EQ(module.bindings[0].name, "uintTexels");
  EXPECT_EQ(module.bindings[1].kind, BindingKind::storageBuffer);
  EXPECT_EQ(module.bindings[1].name, "Out");
  EXPECT_EQ(module.bindings[2].kind, BindingKind::uniformTexelBuffer);
}

TEST(SpirvReflection, LeavesOutBindingsThatNoCodeUses) {
  const Reflection module = reflectKernel("unused_binding");
  ASSERT_EQ(module.bindings.size(), 3u);
  EXPECT_EQ(module.bindings[0].slot, 1u);
  EXPECT_EQ(module.bindings[1].slot, 3u);
  EXPECT_EQ(module.bindings[2].slot, 4u);
  EXPECT_EQ(module.bindings[2].kind, BindingKind::uniformBuffer);
}

TEST(SpirvReflection, MeasuresPushConstants) {
  EXPECT_EQ(reflectKernel("shift_add").pushConstantBytes, 8u);
  EXPECT_EQ(reflectKernel("constants").pushConstantBytes, 0u);
}

TEST(SpirvReflection, FindsTheWorkgroupSizeAndItsConstant) {
  EXPECT_EQ(reflectKernel("constants").workgroupSizeXConstant, 0u);
  EXPECT_EQ(reflectKernel("fixed_workgroup").workgroupSize[0], 128u);
  const Reflection fixed = reflectKernel("needs_int64");
  EXPECT_FALSE(fixed.workgroupSizeXConstant.has_value());
  EXPECT_EQ(fixed.workgroupSize[0], 1u);
}

TEST(SpirvReflection, MeasuresStructsAndTheirMembers) {
  const Reflection module = reflectKernel("unused_binding");
  const auto named = [&module](std::string_view name) {
    for (const ReflectedStruct& reflected : module.structs) {
      if (reflected.name == name) return reflected;
    }
    ADD_FAILURE() << "no struct " << name;
    return ReflectedStruct{};
  };
  const ReflectedStruct item = named("Item");
  ASSERT_EQ(item.members.size(), 2u);
  EXPECT_EQ(item.members[1].name, "id");
  EXPECT_EQ(item.members[1].offset, 12u);
  EXPECT_EQ(item.members[0].bytes, 12u);
  EXPECT_EQ(item.bytes, 16u);
  EXPECT_EQ(item.arrayStride, 16u);
  EXPECT_FALSE(item.isWrapper);
  EXPECT_TRUE(named("Unused").isWrapper);
  EXPECT_FALSE(named("Settings").isWrapper);
}

TEST(SpirvReflection, RefusesWhatIsNoModule) {
  const std::vector<std::uint32_t> noise = {1, 2, 3, 4, 5, 6};
  EXPECT_THROW((void)reflect(noise), std::logic_error);
  EXPECT_THROW((void)reflect({}), std::logic_error);
}

TEST(SpirvReflection, RefusesAModuleThatEndsWithinAnInstruction) {
  const auto whole = test_kernels::spirv("texels");
  EXPECT_NO_THROW((void)reflect(whole));
  EXPECT_THROW((void)reflect(whole.first(6)), std::logic_error);
}

}  // namespace
}  // namespace importon::gpu
