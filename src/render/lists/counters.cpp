#include "render/lists/counters.h"

#include <fmt/format.h>

#include "base/error.h"
#include "kernels/add_counter.h"
#include "kernels/set_counter.h"

namespace importon {

void setCounter(const Stage& stage, uint counter, uint value, uint a, uint b, uint limit) {
  run<kernels::SetCounter>(stage, 1, {.counter = counter, .value = value, .a = a, .b = b, .limit = limit});
}

void addCounter(const Stage& stage, uint counter, uint sum, bool empties) {
  run<kernels::AddCounter>(stage, 1, {.counter = counter, .sum = sum, .empties = empties});
}

bool anyIsAlive(const Stage& stage, uint queue, uint depth) {
  if (depth < 2 || depth % 2 != 0) return true;
  stage.recorder.submitAndWait();
  return readCounter(stage, queue) > 0;
}

void checkLookups(uint unfinished) {
  if (unfinished > 0)
    throw DeviceError(fmt::format("{} lookups of photons or importons were too long for this device", unfinished), "",
                      "choose another with --device, or fewer --photons");
}

}  // namespace importon
