#include "render/lists/room.h"

#include <algorithm>

#include "shared/ray_data.h"

namespace importon {

using gpu::Buffer;
using gpu::TexelFormat;

namespace {

/// Makes room for `room` records and keeps the first `kept` ones.
void resizeRecords(const Stage& stage, std::uint64_t room, std::uint64_t kept) {
  Workspace& work = stage.work;
  const auto grow = [&](gpu::Buffer& buffer, std::uint64_t bytes, bool isKept) {
    resize(stage, buffer, room * bytes, isKept ? kept * bytes : 0);
  };
  for (gpu::Buffer* list : {&work.required, &work.selection, &work.neighbours, &work.accepted})
    grow(*list, sizeof(uint), false);
  grow(work.selectedPoints, sizeof(MapPoint), false);
  grow(work.recordPoints, sizeof(MapPoint), true);
  grow(work.records, sizeof(Record), true);
  if (work.size.hasCells) grow(work.recordCells, sizeof(uvec2), true);
  if (work.hasDifferentials()) {
    grow(work.footprints, sizeof(float), true);
    grow(work.bounds, sizeof(float), false);
  }
  if (work.keep.bytes() < room * sizeof(uint)) grow(work.keep, sizeof(uint), false);
  const std::uint64_t sums = Workspace::blockSumsOf(room, work.entryRoom()) * sizeof(uint);
  if (work.blockSums.bytes() < sums) resize(stage, work.blockSums, sums);
}

}  // namespace

void resize(const Stage& stage, Buffer& buffer, std::uint64_t bytes, std::uint64_t kept) {
  stage.recorder.submitAndWait();  // what was recorded uses the old one
  const std::string name = buffer.name();
  const TexelFormat texels = buffer.texels();
  if (kept == 0) buffer = {};  // its memory is free before more is asked for
  Buffer resized(stage.gpu, name, bytes, texels);
  if (kept > 0) {
    stage.recorder.copy(buffer, 0, resized, 0, kept);
    stage.recorder.submitAndWait();
  }
  buffer = std::move(resized);
}

std::uint64_t roomFor(std::uint64_t needed, std::uint64_t most) { return std::min(needed + needed / 4, most); }

void reserveEntries(const Stage& stage, std::uint64_t entries) {
  Workspace& work = stage.work;
  if (entries <= work.entryRoom()) return;
  const std::uint64_t room = std::max(roomFor(entries, work.size.entries), entries);
  for (Buffer* list : {&work.keysA, &work.keysB, &work.valuesA, &work.valuesB})
    resize(stage, *list, room * sizeof(uint));
  resize(stage, work.blockSums, Workspace::blockSumsOf(work.keep.bytes() / sizeof(uint), room) * sizeof(uint));
}

bool RecordRoom::makeRoom(uint queue, std::uint64_t events) {
  const uint event = event_++;
  if (isEnough_) return anyIsAlive(stage_, queue, event);
  Workspace& work = stage_.work;
  if (event > 0) {
    stage_.recorder.submitAndWait();
    const auto counters = work.counters.download<uint>(kCounterCount);
    records_ = counters[kCounterRecords];
    paths_ = counters[queue];
  }
  if (records_ + paths_ > work.recordRoom())
    resizeRecords(stage_, std::max(roomFor(records_ + paths_, work.size.records), records_ + paths_), records_);
  isEnough_ = records_ + paths_ * events <= work.recordRoom();
  return paths_ > 0;
}

}  // namespace importon
