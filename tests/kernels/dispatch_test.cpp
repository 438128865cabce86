// lib/dispatch.glsl and the way gpu::Recorder lays out workgroups must agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

class Dispatch : public test::GpuTest {
 protected:
  /// Runs count_visits with `run` and expects each index below `count` to be visited once; `padding`
  /// invocations may lie past them.
  template <class Run>
  void expectOneVisitEach(std::uint32_t count, std::uint32_t padding, Run run) {
    const gpu::Kernel kernel(context(), "count_visits", test_kernels::code("count_visits"));
    const gpu::Buffer visits(context(), "visits", (count + 1ull) * sizeof(std::uint32_t));
    const gpu::Buffer* const bindings[] = {&visits};
    gpu::Recorder recorder(context());
    recorder.fill(visits, 0);
    run(recorder, kernel, bindings);
    recorder.submitAndWait();
    const auto counted = visits.download<std::uint32_t>(count + 1ull);
    EXPECT_EQ(std::count(counted.begin(), counted.end() - 1, 1u), count);
    EXPECT_LT(counted[count], padding);
  }
};

TEST_F(Dispatch, GivesEachInvocationItsIndex) {
  const std::vector<std::uint32_t> offsets = {0, 1000, 2000, 3000};
  const auto results = test::runKernel<std::uint32_t, std::uint32_t>(context(), test_kernels::code("dispatch"),
                                                                     std::span<const std::uint32_t>(offsets), 1001);
  for (std::uint32_t i = 0; i < results.size(); ++i) ASSERT_EQ(results[i], i + offsets[i % 4]);
}

TEST_F(Dispatch, FoldsIntoRowsPastTheLimitOfOneDimension) {
  const std::uint64_t most = context().limits().maxWorkgroupCountX * 64ull;
  if (most > 64u << 20) GTEST_SKIP() << "this device folds only at " << most << " invocations";
  const auto count = static_cast<std::uint32_t>(2 * most + 1000);
  expectOneVisitEach(count, 3 * 64, [count](auto& recorder, const auto& kernel, const auto& bindings) {
    recorder.dispatch(kernel, bindings, count, count);
  });
}

TEST_F(Dispatch, IndirectGroupsVisitEachIndexOnce) {
  const gpu::Kernel argumentsKernel(context(), "arguments", test_kernels::code("indirect_arguments"));
  const gpu::Buffer arguments(context(), "arguments", 4 * sizeof(std::uint32_t));
  const gpu::Buffer* const argumentBindings[] = {&arguments};
  struct Push {
    std::uint32_t count, workgroupSize;
  };
  for (const std::uint32_t count : {1u, 64u, 65u, 65535u * 64u, 65535u * 64u + 1u, 2u * 65535u * 64u + 77u}) {
    SCOPED_TRACE(count);
    expectOneVisitEach(count, 4 * 64, [&](auto& recorder, const auto& kernel, const auto& bindings) {
      recorder.dispatch(argumentsKernel, argumentBindings, 1, Push{count, kernel.workgroupSize()});
      recorder.dispatchIndirect(kernel, bindings, arguments, sizeof(std::uint32_t), count);
    });
  }
}

TEST_F(Dispatch, IndirectGroupsOfNothingAreNone) {
  const gpu::Kernel argumentsKernel(context(), "arguments", test_kernels::code("indirect_arguments"));
  const std::vector<std::uint32_t> old = {7, 7, 7, 7};
  const gpu::Buffer arguments = gpu::makeBuffer(context(), "arguments", std::span<const std::uint32_t>(old));
  const gpu::Buffer* const bindings[] = {&arguments};
  gpu::Recorder recorder(context());
  recorder.dispatch(argumentsKernel, bindings, 1, std::uint64_t{64} << 32);
  recorder.submitAndWait();
  EXPECT_EQ(arguments.download<std::uint32_t>(4), (std::vector<std::uint32_t>{7, 0, 1, 1}));
}

}  // namespace
}  // namespace importon
