#include "render/importance/importon_pass.h"

#include "render/lists/lists.h"
#include "render/lists/path_queues.h"
#include "render/lists/room.h"

namespace importon {

void traceImportons(const Stage& stage, const ImportanceMap& global, std::uint32_t count, uint maxDepth,
                    bool knowsImportance) {
  const kernels::ImportonEmit::Push whole{.first = 0,
                                          .count = count,
                                          .pixels = count,
                                          .firstSample = 0,
                                          .total = count,
                                          .isCentred = false,
                                          .isPlanned = false};
  PathQueues queues = startQueues<kernels::ImportonEmit>(stage, whole);
  RecordRoom room(stage, count);
  for (uint depth = 0; depth <= maxDepth && room.makeRoom(queues.counter, maxDepth - depth + 1); ++depth) {
    const buffers::Queue queue{*queues.now};
    traceClosest(stage, queues.counter, queue);
    if (stage.work.hasDifferentials())
      overItems<kernels::ImportonFootprint>(stage, queues.counter, {.source = queues.counter}, queue);
    overItems<kernels::ImportonScatter>(
        stage, queues.counter, {.source = queues.counter, .knowsImportance = knowsImportance}, queue, global.buffers());
    compact(stage, queues.counter, queues.nextCounter, queues.now, *queues.next, kCounterRecords);
    queues.swap();
  }
  addCounter(stage, kCounterRecords, kSumRaysClosest);
}

}  // namespace importon
