#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

class Dispatch : public test::GpuTest {};

TEST_F(Dispatch, GivesEachInvocationItsIndex) {
  const std::vector<std::uint32_t> offsets = {0, 1000, 2000, 3000};
  const auto results = test::runKernel<std::uint32_t, std::uint32_t>(
      context(), test_kernels::spirv("dispatch"), std::span<const std::uint32_t>(offsets), 1001);
  for (std::uint32_t i = 0; i < results.size(); ++i) ASSERT_EQ(results[i], i + offsets[i % 4]);
}

}  // namespace
}  // namespace importon
