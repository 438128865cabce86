/// Room in device memory for what comes, made as it comes.
#pragma once
#include "render/lists/counters.h"

namespace importon {

/// Gives `buffer` room for `bytes` and keeps its first `kept` ones; tables that it is bound in stay right. Waits for
/// the device.
void resize(const Stage& stage, gpu::Buffer& buffer, std::uint64_t bytes, std::uint64_t kept = 0);

/// As many as to make room for when `needed` is more than there is room for: a quarter more, so that it happens rarely.
[[nodiscard]] std::uint64_t roomFor(std::uint64_t needed, std::uint64_t most);

/// Makes room to sort `entries`. What the lists hold is lost. Waits for the device if there is not enough yet.
void reserveEntries(const Stage& stage, std::uint64_t entries);

/// Room for the records of paths that leave one each at every event, made event by event: how many there will be is not
/// known before. Waits for the device as long as those to come might not fit.
class RecordRoom {
 public:
  /// For `paths` paths that have left none yet.
  RecordRoom(const Stage& stage, std::uint64_t paths) : stage_(stage), paths_(paths) {}
  /// Before an event of the paths that `queue` counts, which is one of at most `events` to come. False: no path is
  /// left.
  [[nodiscard]] bool makeRoom(uint queue, std::uint64_t events);

 private:
  const Stage& stage_;
  std::uint64_t paths_, records_ = 0;
  uint event_ = 0;
  bool isEnough_ = false;
};

}  // namespace importon
