#include "gpu/buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include "base/error.h"
#include "gpu/recorder.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

std::vector<std::uint32_t> countingWords(std::size_t count) {
  std::vector<std::uint32_t> words(count);
  std::iota(words.begin(), words.end(), 1u);
  return words;
}

/// Runs with mapped buffers where the device maps them, and with staging.
class BufferTransfer : public test::GpuTest, public ::testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (::testing::Test::IsSkipped() || HasFatalFailure()) return;
    own_ = std::make_unique<Context>(ContextOptions{.validation = true, .stagesTransfers = GetParam()});
  }
  void TearDown() override {
    if (own_) {
      EXPECT_EQ(own_->takeValidationMessages(), std::vector<std::string>{});
    }
    GpuTest::TearDown();
  }
  std::unique_ptr<Context> own_;
};

TEST_P(BufferTransfer, BringsBackWhatWasUploaded) {
  const auto words = countingWords(1000);
  const Buffer buffer = makeBuffer(*own_, "buffer", std::span<const std::uint32_t>(words));
  EXPECT_EQ(buffer.bytes(), 4000u);
  EXPECT_EQ(buffer.download<std::uint32_t>(1000), words);
}

TEST_P(BufferTransfer, ClearedOnesHoldZerosToTheEnd) {
  Buffer buffer = makeBuffer(*own_, "buffer", std::span<const std::uint32_t>(countingWords(1001)));
  buffer.clear();
  EXPECT_EQ(buffer.download<std::uint32_t>(1001), std::vector<std::uint32_t>(1001));
}

TEST_P(BufferTransfer, TransfersLargerThanTheStagingBufferAreWhole) {
  const auto words = countingWords(11 << 20);
  const Buffer buffer = makeBuffer(*own_, "buffer", std::span<const std::uint32_t>(words));
  EXPECT_TRUE(buffer.download<std::uint32_t>(words.size()) == words);
}

TEST_P(BufferTransfer, OffsetsAreInBytesAndLeaveTheRestAlone) {
  Buffer buffer(*own_, "buffer", 16);
  const std::vector<std::uint8_t> zeros(16, 0);
  const std::vector<std::uint8_t> three = {1, 2, 3};
  buffer.upload(std::span<const std::uint8_t>(zeros));
  buffer.upload(std::span<const std::uint8_t>(three), 5);
  EXPECT_EQ(buffer.download<std::uint8_t>(5, 4), (std::vector<std::uint8_t>{0, 1, 2, 3, 0}));
  EXPECT_EQ(buffer.download<std::uint8_t>(8, 8), std::vector<std::uint8_t>(8, 0));
}

TEST_P(BufferTransfer, SeesWhatTheDeviceWrote) {
  const Buffer buffer(*own_, "buffer", 64);
  Recorder recorder(*own_);
  recorder.fill(buffer, 0xABCD1234u);
  recorder.submitAndWait();
  EXPECT_EQ(buffer.download<std::uint32_t>(16), std::vector<std::uint32_t>(16, 0xABCD1234u));
}

INSTANTIATE_TEST_SUITE_P(Paths, BufferTransfer, ::testing::Bool(),
                         [](const auto& path) { return path.param ? "Staged" : "Mapped"; });

class BufferTest : public test::GpuTest {
 protected:
  std::string messageFor(std::uint64_t bytes, TexelFormat texels) {
    try {
      const Buffer buffer(context(), "photon map", bytes, texels);
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(BufferTest, EmptyBufferHoldsOneWord) {
  const Buffer buffer(context(), "empty", 0);
  EXPECT_EQ(buffer.bytes(), 4u);
  EXPECT_TRUE(buffer);
  EXPECT_FALSE(Buffer());
}

TEST_F(BufferTest, RoundsUpToWholeTexels) {
  EXPECT_EQ(Buffer(context(), "texels", 17, TexelFormat::uint4).bytes(), 32u);
  EXPECT_EQ(Buffer(context(), "texels", 0, TexelFormat::float2).bytes(), 8u);
  EXPECT_EQ(Buffer(context(), "words", 17).bytes(), 20u);
}

TEST_F(BufferTest, RefusesMoreThanTheDeviceAllocates) {
  const std::uint64_t most = std::min(context().limits().maxAllocation, context().limits().heapBytes);
  const std::string message = messageFor(most + 1, TexelFormat::none);
  EXPECT_NE(message.find("buffer 'photon map' needs " + std::to_string((most >> 20) + 1) + " MiB"), std::string::npos)
      << message;
  EXPECT_NE(message.find(" is " + std::to_string(most >> 20) + " MiB"), std::string::npos) << message;
}

TEST_F(BufferTest, RefusesMoreTexelsThanTheDeviceAddresses) {
  const std::uint64_t bytes = 4 * (context().limits().maxTexelBufferElements + 1);
  if (bytes > std::min(context().limits().maxAllocation, context().limits().heapBytes)) {
    GTEST_SKIP() << "this device has no memory for that many texels";
  }
  EXPECT_NE(messageFor(bytes, TexelFormat::uint1).find("maxTexelBufferElements"), std::string::npos);
}

TEST_F(BufferTest, TransferPastTheEndIsALogicError) {
  Buffer buffer(context(), "buffer", 16);
  const std::vector<std::uint32_t> words(4);
  EXPECT_THROW(buffer.upload(std::span<const std::uint32_t>(words), 4), std::logic_error);
  EXPECT_THROW((void)buffer.download<std::uint32_t>(5), std::logic_error);
  EXPECT_THROW((void)buffer.download<std::uint32_t>(1, ~0ull - 1), std::logic_error);
}

TEST_F(BufferTest, MovedBufferKeepsItsContents) {
  const auto words = countingWords(4);
  Buffer first = makeBuffer(context(), "first", std::span<const std::uint32_t>(words));
  const Buffer second = std::move(first);
  EXPECT_EQ(second.name(), "first");
  EXPECT_EQ(second.download<std::uint32_t>(4), words);
}

TEST_F(BufferTest, TexelsReachPastTheLimitOfStorageBuffers) {
  const std::uint64_t limit = context().limits().maxStorageBufferRange;
  if (limit > 256u << 20) GTEST_SKIP() << "this device binds " << (limit >> 20) << " MiB as storage buffer";
  const auto index = static_cast<std::uint32_t>(limit / 16 + 1);
  const std::vector<std::uint32_t> uintTexel = {1, 2, 3, 4};
  const std::vector<float> floatTexel = {0.5f, 1.5f, -2.0f, 3.0f};
  Buffer uints(context(), "uints", (index + 1ull) * 16, TexelFormat::uint4);
  Buffer floats(context(), "floats", (index + 1ull) * 16, TexelFormat::float4);
  uints.upload(std::span<const std::uint32_t>(uintTexel), index * 16ull);
  floats.upload(std::span<const float>(floatTexel), index * 16ull);
  const Buffer out(context(), "out", 32);
  const Kernel kernel(context(), "texels", test_kernels::code("texels"));
  const Buffer* const bindings[] = {&uints, &out, &floats};
  Recorder recorder(context());
  recorder.dispatch(kernel, bindings, 1, index);
  recorder.submitAndWait();
  EXPECT_EQ(out.download<std::uint32_t>(4), uintTexel);
  EXPECT_EQ(out.download<float>(4, 16), floatTexel);
}

}  // namespace
}  // namespace importon::gpu
