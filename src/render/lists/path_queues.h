/// The two queues between which paths from the camera go to and fro, event by event.
#pragma once
#include "render/lists/counters.h"

namespace importon {

struct PathQueues {
  explicit PathQueues(const Workspace& work) : now(&work.queueA), next(&work.queueB) {}

  const gpu::Buffer* now;
  const gpu::Buffer* next;
  uint counter = kCounterQueueA;
  uint nextCounter = kCounterQueueB;
  void swap() {
    std::swap(now, next);
    std::swap(counter, nextCounter);
  }
};

/// Fills the first queue by the kernel of `Call`, of the image's paths or of importons.
template <class Call, class... Owners>
PathQueues startQueues(const Stage& stage, const typename Call::Push& push, const Owners&... owners) {
  PathQueues queues(stage.work);
  setCounter(stage, kCounterQueueA, push.count);
  run<Call>(stage, push.count, push, buffers::Queue{*queues.now}, owners...);
  return queues;
}

}  // namespace importon
