#include "render/lists/lists.h"

#include "kernels/compact_count.h"
#include "kernels/compact_scatter.h"
#include "kernels/record_select.h"
#include "kernels/sort_count.h"
#include "kernels/sort_scatter.h"

namespace importon {

using gpu::Buffer;

void compact(const Stage& stage, uint source, uint target, const Buffer* in, const Buffer& out, uint accumulate) {
  overTiles<kernels::CompactCount>(stage, source, {.source = source});
  run<kernels::OneScan>(stage, kScanThreads,
                        {.source = source, .perTile = 1, .target = target, .accumulate = accumulate});
  overTiles<kernels::CompactScatter>(stage, source, {.source = source, .takesIndex = in == nullptr},
                                     buffers::Queue{in != nullptr ? *in : out}, buffers::NextQueue{out});
}

void selectRecords(const Stage& stage, uint mask) {
  overItems<kernels::RecordSelect>(stage, kCounterRecords, {.source = kCounterRecords, .mask = mask});
  compact(stage, kCounterRecords, kCounterSelected, nullptr, stage.work.selection);
}

const Buffer& sortByKey(const Stage& stage, uint source, uint bits, const Buffer& order) {
  Workspace& work = stage.work;
  const Buffer *keysIn = &work.keysA, *keysOut = &work.keysB, *valuesIn = &work.valuesA, *valuesOut = &work.valuesB;
  for (uint shift = 0; shift < bits; shift += kRadixBits) {
    const bool isLast = shift + kRadixBits >= bits;
    overTiles<kernels::SortCount>(stage, source, {.source = source, .shift = shift}, buffers::Keys{*keysIn});
    run<kernels::OneScan>(stage, kScanThreads,
                          {.source = source, .perTile = kRadix, .target = kNone, .accumulate = kNone});
    overTiles<kernels::SortScatter>(stage, source, {.source = source, .shift = shift, .isFirst = shift == 0},
                                    buffers::KeysIn{*keysIn}, buffers::KeysOut{*keysOut}, buffers::ValuesIn{*valuesIn},
                                    buffers::ValuesOut{isLast ? order : *valuesOut});
    std::swap(keysIn, keysOut);
    std::swap(valuesIn, valuesOut);
  }
  return *keysIn;
}

}  // namespace importon
