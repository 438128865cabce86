#include "method/list_stage.h"

namespace importon::test {

void ListTest::SetUp() {
  GpuTest::SetUp();
  if (IsSkipped() || HasFatalFailure()) return;
  work_.emplace(context(), WorkspaceSize{64, 0, kMaxEntries});
  recorder_.emplace(context());
  kernels_.emplace(context(), std::vector<gpu::Specialization>(), false);
  stage_.emplace(Stage{context(), *recorder_, *kernels_, *work_, scene_});
  recorder_->fill(work_->counters, 0);
  resize(*stage_, work_->keep, kMaxEntries * sizeof(uint));
  reserveEntries(*stage_, kMaxEntries);
}

void ListTest::TearDown() {
  stage_.reset();
  recorder_.reset();
  work_.reset();
  kernels_.reset();
  GpuTest::TearDown();
}

void ListTest::setEntries(std::size_t count) { setCounter(stage(), kCounterEntries, static_cast<uint>(count)); }

uint ListTest::counter(uint which) const { return work_->counters.download<uint>(1, which * sizeof(uint)).front(); }

}  // namespace importon::test
