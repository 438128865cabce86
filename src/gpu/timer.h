/// Device time of the commands of one submission, by timestamps, summed by label.
#pragma once
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu/handle.h"
#include "gpu/recorder.h"

namespace importon::gpu {

class Device;

/// One timestamp stands after each command; since a barrier keeps commands apart, the difference of two
/// neighbours is the time of the command between them. Without timestamps only launches are counted.
class Timer {
 public:
  explicit Timer(Device& device);

  /// Before the first command of a submission.
  void begin(VkCommandBuffer commands);
  /// After each command.
  void mark(VkCommandBuffer commands, const std::string& label);
  /// No more commands fit in this submission.
  [[nodiscard]] bool isFull() const;
  /// After the submission is done: adds its times to the sums.
  void collect();
  /// The labels of this submission, for error messages.
  [[nodiscard]] std::string pendingLabels() const;
  [[nodiscard]] const std::vector<KernelTime>& times() const { return times_; }

 private:
  Device& device_;
  QueryPoolHandle queries_;           // empty: no timestamps
  std::vector<std::size_t> pending_;  // indices into times_
  std::vector<std::uint64_t> ticks_;
  std::vector<KernelTime> times_;
  std::unordered_map<std::string, std::size_t> indexOfLabel_;
};

}  // namespace importon::gpu
