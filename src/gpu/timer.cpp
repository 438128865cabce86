#include "gpu/timer.h"

#include <algorithm>

#include "gpu/device.h"
#include "gpu/vulkan_error.h"

namespace importon::gpu {
namespace {

constexpr std::uint32_t kCommandsPerSubmission = 1024;

}  // namespace

Timer::Timer(Device& device) : device_(device) {
  if (device.limits().nanosecondsPerTick == 0) return;
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = kCommandsPerSubmission + 1;
  VkQueryPool pool = VK_NULL_HANDLE;
  check(vkCreateQueryPool(device.handle(), &info, nullptr, &pool), "create a query pool", device.info().name);
  queries_ = {device.handle(), pool};
}

void Timer::begin(VkCommandBuffer commands) {
  pending_.clear();
  if (!queries_) return;
  vkCmdResetQueryPool(commands, queries_.get(), 0, kCommandsPerSubmission + 1);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_.get(), 0);
}

void Timer::mark(VkCommandBuffer commands, const std::string& label) {
  const auto [entry, isNew] = indexOfLabel_.try_emplace(label, times_.size());
  if (isNew) times_.push_back({label, 0, 0});
  pending_.push_back(entry->second);
  if (!queries_) return;
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_.get(),
                      static_cast<std::uint32_t>(pending_.size()));
}

bool Timer::isFull() const { return pending_.size() == kCommandsPerSubmission; }

void Timer::collect() {
  if (queries_) {
    ticks_.resize(pending_.size() + 1);
    check(vkGetQueryPoolResults(device_.handle(), queries_.get(), 0, static_cast<std::uint32_t>(ticks_.size()),
                                ticks_.size() * sizeof(ticks_[0]), ticks_.data(), sizeof(ticks_[0]),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "read timestamps", device_.info().name);
  }
  const double millisecondsPerTick = device_.limits().nanosecondsPerTick * 1e-6;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    KernelTime& time = times_[pending_[i]];
    ++time.launches;
    if (!queries_) continue;
    const std::uint64_t ticks = (ticks_[i + 1] - ticks_[i]) & device_.facts().timestampMask;
    time.milliseconds += static_cast<double>(ticks) * millisecondsPerTick;
  }
  pending_.clear();
}

std::string Timer::pendingLabels() const {
  std::vector<std::size_t> labels = pending_;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::string text;
  for (const std::size_t label : labels) text += (text.empty() ? "" : ", ") + times_[label].label;
  return text;
}

}  // namespace importon::gpu
