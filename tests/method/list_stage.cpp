#include "method/list_stage.h"

#include "kernels/registry.h"
#include "shared/bindings.h"
#include "shared/features.h"

namespace importon::test {

void ListTest::SetUp() {
  GpuTest::SetUp();
  if (IsSkipped() || HasFatalFailure()) return;
  const auto make = [this](const char* name) { return gpu::Kernel(context(), name, kernels::spirv(name)); };
  kernels_.setCounter = make("set_counter");
  kernels_.addCounter = make("add_counter");
  kernels_.compactCount = make("compact_count");
  kernels_.compactScatter = make("compact_scatter");
  const gpu::Specialization scanSize{kSpecWorkgroupSize, kScanThreads};
  kernels_.scan = gpu::Kernel(context(), "scan", kernels::spirv("scan"), std::span(&scanSize, 1));
  kernels_.sortCount = make("sort_count");
  kernels_.sortScatter = make("sort_scatter");
  kernels_.gridCells = make("grid_cells");
  kernels_.gridPoints = make("grid_points");
  work_.emplace(context(), WorkspaceSize{64, 0, kMaxEntries});
  recorder_.emplace(context());
  stage_.emplace(Stage{context(), *recorder_, kernels_, *work_});
  recorder_->fill(work_->counters, 0);
  resize(*stage_, work_->keep, kMaxEntries * sizeof(uint));
  reserveEntries(*stage_, kMaxEntries);
}

void ListTest::TearDown() {
  stage_.reset();
  recorder_.reset();
  work_.reset();
  kernels_ = {};
  GpuTest::TearDown();
}

void ListTest::setEntries(std::size_t count) { setCounter(stage(), kCounterEntries, static_cast<uint>(count)); }

uint ListTest::counter(uint which) const { return work_->counters.download<uint>(1, which * sizeof(uint)).front(); }

}  // namespace importon::test
