/// Tests that need a device: a shared context with validation, and runKernel for testing GLSL functions.
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/kernel.h"
#include "gpu/recorder.h"

namespace importon::test {

/// Base class of tests on the device (`TEST_F`, or derive from it). Without a Vulkan device or validation layer
/// its tests are skipped, saying so; with IMPORTON_REQUIRE_VULKAN=1 in the environment, as in CI, they fail.
/// Any validation message fails the test in which it comes.
class GpuTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// The context that all tests of this process share.
  [[nodiscard]] gpu::Context& context() const;
};

/// The shared context; null if there is no device. For tests that cannot derive from GpuTest.
[[nodiscard]] gpu::Context* sharedContext();

/// Runs a test kernel: it reads items from its buffer `in`, writes `outCount` items to its buffer `out`, and has one
/// push constant, uint count = outCount, with which it compares invocationIndex().
template <class In, class Out>
[[nodiscard]] std::vector<Out> runKernel(gpu::Context& context, const gpu::KernelCode& code, std::span<const In> in,
                                         std::size_t outCount,
                                         std::span<const gpu::Specialization> specialization = {}) {
  const gpu::Kernel kernel(context, "kernel under test", code, specialization);
  const gpu::Buffer input = gpu::makeBuffer(context, "test input", in);
  const gpu::Buffer output(context, "test output", outCount * sizeof(Out));
  std::vector<const gpu::Buffer*> bindings;
  for (const gpu::KernelBuffer& buffer : code.buffers) bindings.push_back(buffer.name == "in" ? &input : &output);
  gpu::Recorder recorder(context);
  recorder.dispatch(kernel, bindings, outCount, static_cast<std::uint32_t>(outCount));
  recorder.submitAndWait();
  return output.download<Out>(outCount);
}

/// The same with a vector as input and as many items out as in.
template <class Out, class In>
[[nodiscard]] std::vector<Out> runKernel(gpu::Context& context, const gpu::KernelCode& code, const std::vector<In>& in,
                                         std::span<const gpu::Specialization> specialization = {}) {
  return runKernel<In, Out>(context, code, std::span<const In>(in), in.size(), specialization);
}

}  // namespace importon::test
