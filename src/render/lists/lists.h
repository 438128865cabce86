/// Lists in device memory: compaction, selection, sorting.
#pragma once
#include "render/lists/counters.h"

namespace importon {

/// Stable compaction of the `source` entries whose `keep` is 1: `out` receives their indices (takesIndex) or
/// the values of `in` there; `target` their number. `accumulate`, if any, grows by `source`.
void compact(const Stage& stage, uint source, uint target, const gpu::Buffer* in, const gpu::Buffer& out,
             uint accumulate = kNone);

/// Selects the records of which `mask` holds a bit: their indices in work.selection, their number in kCounterSelected.
void selectRecords(const Stage& stage, uint mask);

/// Stable sort of the `source` entries by the `bits` low bits of work.keysA. `order` receives their indices;
/// the sorted keys are in the returned buffer.
const gpu::Buffer& sortByKey(const Stage& stage, uint source, uint bits, const gpu::Buffer& order);

}  // namespace importon
