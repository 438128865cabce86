#include "render/importance/importon_pass.h"

#include "render/lists/lists.h"
#include "render/lists/path_queues.h"
#include "render/lists/room.h"
#include "shared/bindings.h"

namespace importon {

void traceImportons(const Stage& stage, const ImportanceMap& global, std::uint32_t count, uint maxDepth,
                    bool knowsImportance) {
  gpu::BindingTable table = stage.work.table;
  global.bind(table);
  PathQueues queues =
      startQueues(stage, stage.kernels.importonEmit, table, EyeEmitPush{0, count, count, 0, count, 0, 0});
  RecordRoom room(stage, count);
  for (uint depth = 0; depth <= maxDepth && room.makeRoom(queues.counter, maxDepth - depth + 1); ++depth) {
    table.set(kBindingQueue, *queues.now);
    overRays(stage, stage.kernels.traceClosest, table, queues.counter, TracePush{queues.counter});
    if (stage.work.hasDifferentials())
      overItems(stage, stage.kernels.importonDifferential, table, queues.counter,
                ImportonDifferentialPush{queues.counter});
    overItems(stage, stage.kernels.importonScatter, table, queues.counter,
              EyeScatterPush{queues.counter, knowsImportance});
    compact(stage, queues.counter, queues.nextCounter, queues.now, *queues.next, kCounterRecords);
    queues.swap();
  }
  addCounter(stage, kCounterRecords, kSumRaysClosest);
}

}  // namespace importon
