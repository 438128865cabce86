// Modules specialised before a driver sees them: valid, smaller, and as they were where nothing is known. That they
// compute the same bits is a test of whole renders.
#include "gpu/specialise_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <spirv-tools/libspirv.hpp>
#include <stdexcept>

#include "gpu/kernel_cache.h"
#include "kernels/registry.h"
#include "shared/features.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

void expectValid(const Words& module, std::string_view name) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
  tools.SetMessageConsumer([name](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    ADD_FAILURE() << name << ": " << message;
  });
  spvtools::ValidatorOptions layout;
  layout.SetScalarBlockLayout(true);
  EXPECT_TRUE(tools.Validate(module.data(), module.size(), layout));
}

std::vector<Specialization> constantsOf(std::span<const std::uint32_t> module, const auto& valueOf) {
  std::vector<Specialization> constants;
  for (const std::uint32_t id : declaredConstants(module)) constants.push_back({id, valueOf(id)});
  return constants;
}

std::size_t openConstants(const Words& module) {
  const std::vector<std::uint32_t> ids = declaredConstants(module);
  return ids.size() - static_cast<std::size_t>(std::ranges::count(ids, kSpecWorkgroupSize));
}

TEST(SpecialisedModule, OfEveryKernelIsValidWhateverIsChosen) {
  std::mt19937 random(1);
  for (const KernelCode* code : kernels::all()) {
    for (const auto module : {code->spirv(), code->lean(), code->placed()}) {
      if (module.empty()) continue;
      for (int trial = 0; trial < 2; ++trial) {
        const Words made =
            specialised(module, constantsOf(module, [&](std::uint32_t id) {
                          return id == kSpecWorkgroupSize ? 64u : static_cast<std::uint32_t>(random() % 2);
                        }));
        expectValid(made, code->name);
        EXPECT_LE(made.size(), module.size()) << code->name;
      }
    }
  }
}

TEST(SpecialisedModule, LeavesNoConstantOpenButTheWorkgroupSizeAndDropsWhatASceneHasNot) {
  std::size_t kept = 0, all = 0;
  for (const KernelCode* code : kernels::all()) {
    const Words made = specialised(code->spirv(), constantsOf(code->spirv(), [](std::uint32_t) { return 0u; }));
    EXPECT_TRUE(openConstants(made) == 0 || made.size() == code->spirv().size()) << code->name;
    kept += made.size();
    all += code->spirv().size();
  }
  EXPECT_LT(kept, all / 2);
}

TEST(SpecialisedModule, ThatIsCutShortIsAnError) {
  constexpr std::size_t kCutShort = 6;  // in its first instruction
  const auto module = test_kernels::code("shift_add").spirv();
  EXPECT_THROW((void)specialised(module.first(kCutShort), {}), std::logic_error);
}

}  // namespace
}  // namespace importon::gpu
