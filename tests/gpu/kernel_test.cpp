#include "gpu/kernel.h"

#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "gpu/recorder.h"
#include "shared/features.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

class KernelTest : public test::GpuTest {
 protected:
  /// Workgroup size and constants as the kernel `constants` sees them.
  std::vector<std::uint32_t> constantsSeen(std::span<const Specialization> specialization) {
    return seenBy(test_kernels::code("constants"), specialization, 4);
  }

  /// Words that the kernel writes.
  std::vector<std::uint32_t> seenBy(const KernelCode& code, std::span<const Specialization> specialization,
                                    std::size_t words) {
    const Kernel kernel(context(), std::string(code.name), code, specialization);
    const Buffer out(context(), "out", words * sizeof(std::uint32_t));
    const Buffer* const bindings[] = {&out};
    Recorder recorder(context());
    recorder.dispatch(kernel, bindings, 1);
    recorder.submitAndWait();
    return out.download<std::uint32_t>(words);
  }
};

TEST_F(KernelTest, HasWorkgroupsOf64AndItsOwnConstantsByDefault) {
  EXPECT_EQ(constantsSeen({}), (std::vector<std::uint32_t>{64, 11, std::bit_cast<std::uint32_t>(0.5f), 0}));
}

TEST_F(KernelTest, TakesConstantsAndWorkgroupSizeFromTheSpecialization) {
  const std::uint32_t scale = std::bit_cast<std::uint32_t>(2.25f);
  const std::vector<Specialization> specialization = {{3, 1}, {0, 32}, {1, 99}, {2, scale}};
  EXPECT_EQ(constantsSeen(specialization), (std::vector<std::uint32_t>{32, 99, scale, 1}));
  const Kernel kernel(context(), "constants", test_kernels::code("constants"), specialization);
  EXPECT_EQ(kernel.workgroupSize(), 32u);
}

TEST_F(KernelTest, HasRareFeaturesUnlessAllAreOff) {
  const KernelCode& code = test_kernels::code("rare");
  for (const std::uint32_t one : {0u, 1u})
    for (const std::uint32_t other : {0u, 1u})
      for (const std::uint32_t common : {0u, 1u}) {
        const std::vector<Specialization> all = {
            {kSpecHasSheen, one}, {kSpecHasDispersion, other}, {kSpecHasMedia, common}};
        EXPECT_EQ(seenBy(code, all, 3), (std::vector<std::uint32_t>{one, other, common}));
      }
  EXPECT_EQ(seenBy(code, {}, 3), (std::vector<std::uint32_t>{1, 1, 1}));
  EXPECT_EQ(seenBy(code, std::vector<Specialization>{{kSpecHasSheen, 0}}, 3), (std::vector<std::uint32_t>{0, 1, 1}));
}

TEST_F(KernelTest, KeepsTheWorkgroupSizeThatTheKernelDeclares) {
  const Kernel kernel(context(), "fixed", test_kernels::code("fixed_workgroup"));
  EXPECT_EQ(kernel.workgroupSize(), 128u);
  const Buffer out(context(), "out", 256 * 4);
  const Buffer* const bindings[] = {&out};
  Recorder recorder(context());
  recorder.dispatch(kernel, bindings, 256);
  recorder.submitAndWait();
  const auto results = out.download<std::uint32_t>(256);
  for (std::uint32_t i = 0; i < 256; ++i) ASSERT_EQ(results[i], 127 - i % 128);
}

TEST_F(KernelTest, RefusesAWorkgroupSizeAboveTheLimit) {
  const Specialization tooLarge{0, context().limits().maxWorkgroupSize + 1};
  EXPECT_THROW(Kernel(context(), "large", test_kernels::code("constants"), std::span(&tooLarge, 1)), DeviceError);
  const Specialization none{0, 0};
  EXPECT_THROW(Kernel(context(), "none", test_kernels::code("constants"), std::span(&none, 1)), DeviceError);
}

TEST_F(KernelTest, MayBeMadeByManyThreads) {
  std::vector<Kernel> kernels(8);
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < kernels.size(); ++i) {
    threads.emplace_back([&, i] {
      const Specialization count{1, i};
      kernels[i] = Kernel(context(), "constants", test_kernels::code("constants"), std::span(&count, 1));
      kernels[i].compile();
    });
  }
  for (std::thread& thread : threads) thread.join();
  const Buffer out(context(), "out", 16);
  const Buffer* const bindings[] = {&out};
  Recorder recorder(context());
  for (std::uint32_t i = 0; i < kernels.size(); ++i) {
    recorder.dispatch(kernels[i], bindings, 1);
    recorder.submitAndWait();
    EXPECT_EQ(out.download<std::uint32_t>(2)[1], i);
  }
}

TEST_F(KernelTest, MissingBufferIsALogicErrorThatNamesKernelAndBuffer) {
  const Kernel kernel(context(), "shift", test_kernels::code("shift_add"));
  const Buffer buffer(context(), "buffer", 64);
  const Buffer* const bindings[] = {&buffer, nullptr};
  Recorder recorder(context());
  struct Push {
    std::uint32_t count = 1, step = 1;
  };
  try {
    recorder.dispatch(kernel, bindings, 1, Push{});
    FAIL() << "no error";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "kernel 'shift', buffer 'out': there is none");
  }
}

TEST_F(KernelTest, BufferWithoutTexelFormatIsRefusedWhereTexelsAreRead) {
  const Kernel kernel(context(), "texels", test_kernels::code("texels"));
  const Buffer buffer(context(), "plain", 64);
  const Buffer* const bindings[] = {&buffer, &buffer, &buffer};
  Recorder recorder(context());
  EXPECT_THROW(recorder.dispatch(kernel, bindings, 1, 0u), std::logic_error);
}

TEST_F(KernelTest, PushConstantsOfAnotherSizeAreALogicError) {
  const Kernel kernel(context(), "shift", test_kernels::code("shift_add"));
  const Buffer buffer(context(), "buffer", 64);
  const Buffer* const bindings[] = {&buffer, &buffer};
  Recorder recorder(context());
  EXPECT_THROW(recorder.dispatch(kernel, bindings, 1, 1u), std::logic_error);
  EXPECT_THROW(recorder.dispatch(kernel, bindings, 1), std::logic_error);
}

TEST_F(KernelTest, BufferTooLargeToBindIsADeviceErrorWithNeedAndLimit) {
  const std::uint64_t limit = context().limits().maxStorageBufferRange;
  if (limit > 256u << 20) GTEST_SKIP() << "this device binds " << (limit >> 20) << " MiB as storage buffer";
  const Buffer large(context(), "large", limit + 4);
  const Kernel kernel(context(), "constants", test_kernels::code("constants"));
  const Buffer* const bindings[] = {&large};
  Recorder recorder(context());
  try {
    recorder.dispatch(kernel, bindings, 1);
    FAIL() << "no error";
  } catch (const DeviceError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'large' of " + std::to_string(limit + 4)), std::string::npos) << message;
    EXPECT_NE(message.find("maxStorageBufferRange " + std::to_string(limit)), std::string::npos) << message;
  }
}

TEST_F(KernelTest, AnotherNumberOfBuffersIsALogicError) {
  const Kernel kernel(context(), "shift", test_kernels::code("shift_add"));
  const Buffer buffer(context(), "buffer", 64);
  const Buffer* const bindings[] = {&buffer};
  Recorder recorder(context());
  EXPECT_THROW(recorder.dispatch(kernel, bindings, 1, std::uint64_t{0}), std::logic_error);
}

TEST_F(KernelTest, UnknownKernelIsALogicError) { EXPECT_THROW((void)test_kernels::code("noise"), std::logic_error); }

}  // namespace
}  // namespace importon::gpu
