#include "render/lists/lists.h"

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

using gpu::Buffer;

void compact(const Stage& stage, uint source, uint target, const Buffer* in, const Buffer& out, uint accumulate) {
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingQueue, in != nullptr ? *in : out);
  table.set(kBindingNextQueue, out);
  overTiles(stage, stage.kernels.compactCount, table, source, CompactCountPush{source});
  stage.recorder.dispatch(stage.kernels.scan, table, kScanThreads, ScanPush{source, 1, target, accumulate});
  overTiles(stage, stage.kernels.compactScatter, table, source, CompactScatterPush{source, in == nullptr});
}

void selectRecords(const Stage& stage, uint mask) {
  overItems(stage, stage.kernels.recordSelect, stage.work.table, kCounterRecords,
            RecordSelectPush{kCounterRecords, mask});
  compact(stage, kCounterRecords, kCounterSelected, nullptr, stage.work.selection);
}

const Buffer& sortByKey(const Stage& stage, uint source, uint bits, const Buffer& order) {
  Workspace& work = stage.work;
  const Buffer *keysIn = &work.keysA, *keysOut = &work.keysB, *valuesIn = &work.valuesA, *valuesOut = &work.valuesB;
  gpu::BindingTable table = work.table;
  for (uint shift = 0; shift < bits; shift += kRadixBits) {
    const bool isLast = shift + kRadixBits >= bits;
    table.set(kBindingKeysIn, *keysIn);
    table.set(kBindingKeysOut, *keysOut);
    table.set(kBindingValuesIn, *valuesIn);
    table.set(kBindingValuesOut, isLast ? order : *valuesOut);
    overTiles(stage, stage.kernels.sortCount, table, source, SortCountPush{source, shift});
    stage.recorder.dispatch(stage.kernels.scan, table, kScanThreads, ScanPush{source, kRadix, kNone, kNone});
    overTiles(stage, stage.kernels.sortScatter, table, source, SortScatterPush{source, shift, shift == 0});
    std::swap(keysIn, keysOut);
    std::swap(valuesIn, valuesOut);
  }
  return *keysIn;
}

}  // namespace importon
