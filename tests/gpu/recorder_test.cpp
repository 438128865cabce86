#include "gpu/recorder.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>
#include <vector>

#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

constexpr std::uint32_t kCount = 1000;

struct ShiftAddPush {
  std::uint32_t count, step;
};

class RecorderTest : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    shiftAdd_ = Kernel(context(), "shift add", test_kernels::code("shift_add"));
    std::vector<std::uint32_t> start(kCount);
    std::iota(start.begin(), start.end(), 0u);
    buffers_[0] = makeBuffer(context(), "ping", std::span<const std::uint32_t>(start));
    buffers_[1] = Buffer(context(), "pong", kCount * sizeof(std::uint32_t));
  }

  /// Records `steps` dispatches, each of which reads what the one before wrote.
  void recordChain(Recorder& recorder, std::uint32_t steps) {
    for (std::uint32_t i = 0; i < steps; ++i) {
      const Buffer* const bindings[] = {&buffers_[i % 2], &buffers_[(i + 1) % 2]};
      recorder.dispatch(shiftAdd_, bindings, kCount, ShiftAddPush{kCount, i});
    }
  }

  void expectChain(std::uint32_t steps) {
    const auto results = buffers_[steps % 2].download<std::uint32_t>(kCount);
    const std::uint32_t sum = steps * (steps - 1) / 2;
    for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(results[i], (i + steps) % kCount + sum);
  }

  Kernel shiftAdd_;
  Buffer buffers_[2];
};

TEST_F(RecorderTest, SmokeRunsAChainOfDependentDispatchesInOrder) {
  Recorder recorder(context());
  recordChain(recorder, 1000);
  recorder.submitAndWait();
  expectChain(1000);
}

TEST_F(RecorderTest, SubmitsALongRecordingInPieces) {
  Recorder recorder(context());
  recordChain(recorder, 2500);
  recorder.submitAndWait();
  expectChain(2500);
  ASSERT_EQ(recorder.times().size(), 1u);
  EXPECT_EQ(recorder.times()[0].launches, 2500u);
}

TEST_F(RecorderTest, MayBeUsedAgainAfterASubmission) {
  Recorder recorder(context());
  recordChain(recorder, 10);
  recorder.submitAndWait();
  recorder.submitAndWait();
  recorder.fill(buffers_[0], 5);
  recorder.submitAndWait();
  EXPECT_EQ(buffers_[0].download<std::uint32_t>(kCount), std::vector<std::uint32_t>(kCount, 5));
}

TEST_F(RecorderTest, OrdersFillsCopiesAndDispatches) {
  const Buffer copied(context(), "copied", kCount * sizeof(std::uint32_t));
  Recorder recorder(context());
  const Buffer* const bindings[] = {&buffers_[0], &buffers_[1]};
  for (std::uint32_t round = 0; round < 50; ++round) {
    recorder.fill(buffers_[0], round);
    recorder.dispatch(shiftAdd_, bindings, kCount, ShiftAddPush{kCount, 100});
    recorder.copy(buffers_[1], 0, copied, 0, copied.bytes());
    recorder.fill(buffers_[1], 0);
  }
  recorder.submitAndWait();
  EXPECT_EQ(copied.download<std::uint32_t>(kCount), std::vector<std::uint32_t>(kCount, 149));
}

TEST_F(RecorderTest, CopiesTheBytesAskedFor) {
  const Buffer to(context(), "to", 16);
  Recorder recorder(context());
  recorder.fill(to, 7);
  recorder.copy(buffers_[0], 40, to, 4, 8);
  recorder.copy(buffers_[0], 0, to, 0, 0);
  recorder.submitAndWait();
  EXPECT_EQ(to.download<std::uint32_t>(4), (std::vector<std::uint32_t>{7, 10, 11, 7}));
}

TEST_F(RecorderTest, TransferPastTheEndIsALogicError) {
  const Buffer small(context(), "small", 8);
  Recorder recorder(context());
  EXPECT_THROW(recorder.copy(buffers_[0], 0, small, 0, 12), std::logic_error);
  EXPECT_THROW(recorder.copy(small, 4, buffers_[0], 0, 8), std::logic_error);
  EXPECT_THROW(recorder.dispatchIndirect(shiftAdd_, {}, small, 0, ShiftAddPush{}), std::logic_error);
}

TEST_F(RecorderTest, DispatchOfNothingDoesNothing) {
  Recorder recorder(context());
  recorder.dispatch(shiftAdd_, {}, 0, ShiftAddPush{});
  recorder.submitAndWait();
  EXPECT_TRUE(recorder.times().empty());
}

TEST_F(RecorderTest, RefusesMoreInvocationsThanIndices) {
  Recorder recorder(context());
  EXPECT_THROW(recorder.dispatch(shiftAdd_, {}, (1ull << 32) + 1, ShiftAddPush{}), std::logic_error);
}

TEST_F(RecorderTest, GoesOnAfterARefusedDispatch) {
  Recorder recorder(context());
  EXPECT_THROW(recorder.dispatch(shiftAdd_, {}, 1, ShiftAddPush{}), std::logic_error);
  recordChain(recorder, 4);
  recorder.submitAndWait();
  expectChain(4);
}

TEST_F(RecorderTest, SumsTimesByLabelInOrderOfFirstUse) {
  if (context().limits().nanosecondsPerTick == 0) GTEST_SKIP() << "this device has no timestamps";
  const Kernel other(context(), "other", test_kernels::code("shift_add"));
  const Buffer* const bindings[] = {&buffers_[0], &buffers_[1]};
  Recorder recorder(context());
  for (int round = 0; round < 3; ++round) {
    recordChain(recorder, 4);
    recorder.dispatch(other, bindings, kCount, ShiftAddPush{kCount, 1});
    recorder.fill(buffers_[0], 0);
    recorder.submitAndWait();
  }
  const auto times = recorder.times();
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0].label, "shift add");
  EXPECT_EQ(times[0].launches, 12u);
  EXPECT_EQ(times[1].label, "other");
  EXPECT_EQ(times[1].launches, 3u);
  EXPECT_EQ(times[2].label, "fill");
  for (const KernelTime& time : times) {
    EXPECT_GT(time.milliseconds, 0.0) << time.label;
    EXPECT_LT(time.milliseconds, 10000.0) << time.label;
  }
}

TEST_F(RecorderTest, LongerWorkTakesMoreTime) {
  if (context().limits().nanosecondsPerTick == 0) GTEST_SKIP() << "this device has no timestamps";
  const Kernel shortWork(context(), "short", test_kernels::code("count_visits"));
  const Kernel longWork(context(), "long", test_kernels::code("count_visits"));
  const Buffer visits(context(), "visits", 8 << 20);
  const Buffer* const bindings[] = {&visits};
  Recorder recorder(context());
  recorder.fill(visits, 0);
  recorder.dispatch(longWork, bindings, 2u << 20, (2u << 20) - 1);
  recorder.dispatch(shortWork, bindings, 64, 64u);
  recorder.submitAndWait();
  const auto times = recorder.times();
  EXPECT_GT(times[1].milliseconds, times[2].milliseconds);
}

TEST_F(RecorderTest, SeveralMayRunAtOnceInThreads) {
  std::vector<std::thread> threads;
  std::vector<Buffer> buffers(4);
  for (std::uint32_t i = 0; i < buffers.size(); ++i) {
    threads.emplace_back([&, i] {
      buffers[i] = Buffer(context(), "own", 64);
      Recorder recorder(context());
      for (std::uint32_t round = 0; round < 20; ++round) {
        recorder.fill(buffers[i], i * 100 + round);
        recorder.submitAndWait();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::uint32_t i = 0; i < buffers.size(); ++i) EXPECT_EQ(buffers[i].download<std::uint32_t>(1)[0], i * 100 + 19);
}

}  // namespace
}  // namespace importon::gpu
