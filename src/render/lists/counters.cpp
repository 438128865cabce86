#include "render/lists/counters.h"

#include "shared/push_data.h"

namespace importon {

void setCounter(const Stage& stage, uint counter, uint value, uint a, uint b, uint limit) {
  stage.recorder.dispatch(stage.kernels.setCounter, stage.work.table, 1, SetCounterPush{counter, value, a, b, limit});
}

void addCounter(const Stage& stage, uint counter, uint sum, bool empties) {
  stage.recorder.dispatch(stage.kernels.addCounter, stage.work.table, 1, AddCounterPush{counter, sum, empties});
}

}  // namespace importon
