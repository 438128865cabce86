/// The two queues between which paths from the camera go to and fro, event by event.
#pragma once
#include "render/lists/counters.h"
#include "shared/push_data.h"

namespace importon {

struct PathQueues {
  const gpu::Buffer* now;
  const gpu::Buffer* next;
  uint counter = kCounterQueueA;
  uint nextCounter = kCounterQueueB;
  void swap() {
    std::swap(now, next);
    std::swap(counter, nextCounter);
  }
};

/// Fills the first queue by `emit`, of the image's paths or of importons, and binds it.
PathQueues startQueues(const Stage& stage, const gpu::Kernel& emit, gpu::BindingTable& table, const EyeEmitPush& push);

}  // namespace importon
