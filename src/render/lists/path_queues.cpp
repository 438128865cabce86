#include "render/lists/path_queues.h"

#include "shared/bindings.h"

namespace importon {

PathQueues startQueues(const Stage& stage, const gpu::Kernel& emit, gpu::BindingTable& table, const EyeEmitPush& push) {
  PathQueues queues{&stage.work.queueA, &stage.work.queueB};
  table.set(kBindingQueue, *queues.now);
  setCounter(stage, kCounterQueueA, push.count);
  stage.recorder.dispatch(emit, table, push.count, push);
  return queues;
}

}  // namespace importon
