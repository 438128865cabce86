// Host and kernels read the same headers; here is checked that they also mean the same bytes.
#include "gpu/layout.h"

#include <gtest/gtest.h>

#include <set>

#include "kernels/registry.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

using test::difference;
using test::hostLayouts;

/// Compares all structs in the blocks of a module; adds the names of those seen.
void expectSameLayout(std::string_view kernel, std::span<const std::uint32_t> spirv, std::set<std::string>& seen) {
  const Reflection module = reflect(spirv);
  EXPECT_LE(module.pushConstantBytes, 128u) << kernel;
  const auto host = hostLayouts();
  for (const ReflectedStruct& reflected : module.structs) {
    if (reflected.isWrapper) continue;
    EXPECT_EQ(difference(reflected, host), "") << "kernel " << kernel;
    seen.insert(reflected.name);
  }
}

TEST(Layout, ShippedKernelsLayOutSharedStructsAsTheHostDoes) {
  std::set<std::string> seen;
  for (const std::string_view name : kernels::names()) expectSameLayout(name, kernels::spirv(name), seen);
}

TEST(Layout, EverySharedStructOfTheSceneIsLaidOutAsOnTheHost) {
  std::set<std::string> seen;
  expectSameLayout("shared_structs", test_kernels::spirv("shared_structs"), seen);
  const std::set<std::string> all = {"Vertex", "Triangle", "Material", "Texture", "Light", "Ray", "Hit"};
  EXPECT_EQ(seen, all);
}

/// A struct of a module that fits the host's Hit.
ReflectedStruct hit() { return {"Hit", {{"t", 0, 4}, {"u", 4, 4}, {"v", 8, 4}, {"triangle", 12, 4}}, 16, 16, false}; }

TEST(Layout, DifferenceIsEmptyForTheSameLayout) { EXPECT_EQ(difference(hit(), hostLayouts()), ""); }

TEST(Layout, DifferenceNamesAnUnlistedStruct) {
  ReflectedStruct other = hit();
  other.name = "Miss";
  EXPECT_EQ(difference(other, hostLayouts()), "Miss: not listed in tests/gpu/layouts.cpp");
}

TEST(Layout, DifferenceNamesWhatDiffers) {
  ReflectedStruct fewer = hit();
  fewer.members.pop_back();
  EXPECT_EQ(difference(fewer, hostLayouts()), "Hit: number of members 3 in the kernel, 4 on the host");
  ReflectedStruct shifted = hit();
  shifted.members[3].offset = 16;
  EXPECT_EQ(difference(shifted, hostLayouts()), "Hit: offset of triangle 16 in the kernel, 12 on the host");
  ReflectedStruct swapped = hit();
  std::swap(swapped.members[1].name, swapped.members[2].name);
  EXPECT_EQ(difference(swapped, hostLayouts()), "Hit: member v is u on the host");
  ReflectedStruct wider = hit();
  wider.members[0].bytes = 8;
  EXPECT_EQ(difference(wider, hostLayouts()), "Hit: size of t 8 in the kernel, 4 on the host");
  ReflectedStruct padded = hit();
  padded.arrayStride = 32;
  EXPECT_EQ(difference(padded, hostLayouts()), "Hit: array stride 32 in the kernel, 16 on the host");
}

}  // namespace
}  // namespace importon::gpu
