#include "gpu/recorder.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "gpu/buffer_impl.h"
#include "gpu/commands.h"
#include "gpu/descriptor_arena.h"
#include "gpu/kernel_impl.h"
#include "gpu/timer.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

struct GroupCounts {
  std::uint32_t x, y;
};

/// Workgroups for `invocations`, in as few rows as the device's limits allow.
GroupCounts groupCounts(const Kernel& kernel, const Device& device, std::uint64_t invocations) {
  const std::uint64_t groups = (invocations + kernel.workgroupSize() - 1) / kernel.workgroupSize();
  const std::uint64_t rows = (groups + device.facts().maxWorkgroupCount[0] - 1) / device.facts().maxWorkgroupCount[0];
  const std::uint64_t columns = (groups + rows - 1) / rows;
  const std::uint64_t covered = rows * columns * kernel.workgroupSize();
  if (rows > device.facts().maxWorkgroupCount[1] || covered > (1ull << 32)) {
    throw std::logic_error("kernel '" + kernel.label() + "': " + std::to_string(invocations) +
                           " invocations are too many for one dispatch");
  }
  return {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
}

void checkTransfer(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes) {
  if (offset > buffer.bytes() || bytes > buffer.bytes() - offset) {
    throw std::logic_error("a copy passes the end of buffer '" + buffer.name() + "'");
  }
}

}  // namespace

struct Recorder::Impl {
  explicit Impl(std::shared_ptr<Device> sharedDevice)
      : device(std::move(sharedDevice)),
        commandPool(createCommandPool(*device)),
        commands(allocateCommandBuffer(*device, commandPool.get())),
        fence(createFence(*device)),
        descriptors(*device),
        timer(*device) {}

  /// Starts a submission if none is being recorded, and sets this command apart from the one before.
  void beginCommand() {
    if (isRecording && timer.isFull()) submitAndWait();
    if (isRecording) {
      recordBarrier(commands);
      return;
    }
    beginCommands(*device, commands);
    timer.begin(commands);
    isRecording = true;
  }

  void bind(const Kernel& kernel, VkDescriptorSet set, std::span<const std::byte> pushConstants) {
    const Kernel::Impl& impl = kernel.impl();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, impl.pipeline.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, impl.pipelineLayout.get(), 0, 1, &set, 0,
                            nullptr);
    if (pushConstants.empty()) return;
    vkCmdPushConstants(commands, impl.pipelineLayout.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(pushConstants.size()), pushConstants.data());
  }

  /// Records all that a dispatch needs but the dispatch itself.
  void prepare(const Kernel& kernel, std::span<const Buffer* const> buffers, std::span<const std::byte> pushConstants) {
    if (pushConstants.size() != kernel.impl().code->pushConstantBytes) {
      throw std::logic_error("kernel '" + kernel.label() + "' takes " +
                             std::to_string(kernel.impl().code->pushConstantBytes) + " bytes of push constants, not " +
                             std::to_string(pushConstants.size()));
    }
    kernel.compile();
    beginCommand();
    bind(kernel, descriptors.bind(kernel, buffers), pushConstants);
  }

  void submitAndWait() {
    if (!isRecording) return;
    recordBarrier(commands);
    isRecording = false;
    const std::string where = device->info().name;
    check(vkEndCommandBuffer(commands), "record commands", where);
    const VkResult result = device->submitAndWait(commands, fence.get());
    if (result != VK_SUCCESS) throwDeviceError(result, "run " + timer.pendingLabels(), where);
    timer.collect();
    descriptors.reset();
  }

  std::shared_ptr<Device> device;  // shared: see Device
  CommandPoolHandle commandPool;
  VkCommandBuffer commands;
  FenceHandle fence;
  DescriptorArena descriptors;
  Timer timer;
  bool isRecording = false;
};

Recorder::Recorder(Context& context) : impl_(std::make_unique<Impl>(context.impl().device)) {}
Recorder::~Recorder() = default;

void Recorder::dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers, std::uint64_t invocations,
                        std::span<const std::byte> pushConstants) {
  if (invocations == 0) return;
  const GroupCounts groups = groupCounts(kernel, *impl_->device, invocations);
  impl_->prepare(kernel, buffers, pushConstants);
  vkCmdDispatch(impl_->commands, groups.x, groups.y, 1);
  impl_->timer.mark(impl_->commands, kernel.label());
}

void Recorder::dispatchIndirect(const Kernel& kernel, std::span<const Buffer* const> buffers, const Buffer& arguments,
                                std::uint64_t offset, std::span<const std::byte> pushConstants) {
  checkTransfer(arguments, offset, sizeof(VkDispatchIndirectCommand));
  if (offset % 4 != 0) throw std::logic_error("indirect arguments must lie at a multiple of 4 bytes");
  impl_->prepare(kernel, buffers, pushConstants);
  vkCmdDispatchIndirect(impl_->commands, arguments.impl().buffer.get(), offset);
  impl_->timer.mark(impl_->commands, kernel.label());
}

void Recorder::fill(const Buffer& buffer, std::uint32_t value) {
  impl_->beginCommand();
  vkCmdFillBuffer(impl_->commands, buffer.impl().buffer.get(), 0, VK_WHOLE_SIZE, value);
  impl_->timer.mark(impl_->commands, "fill");
}

void Recorder::copy(const Buffer& from, std::uint64_t fromOffset, const Buffer& to, std::uint64_t toOffset,
                    std::uint64_t bytes) {
  if (bytes == 0) return;
  checkTransfer(from, fromOffset, bytes);
  checkTransfer(to, toOffset, bytes);
  impl_->beginCommand();
  const VkBufferCopy region{fromOffset, toOffset, bytes};
  vkCmdCopyBuffer(impl_->commands, from.impl().buffer.get(), to.impl().buffer.get(), 1, &region);
  impl_->timer.mark(impl_->commands, "copy");
}

void Recorder::submitAndWait() { impl_->submitAndWait(); }

std::vector<KernelTime> Recorder::times() const { return impl_->timer.times(); }

}  // namespace importon::gpu
