#include "render/pause.h"

#include <cstring>

#include "base/error.h"

namespace importon {
namespace {

constexpr std::chrono::seconds kInterval{60};
constexpr const char* kTrendName = "error trend";

}  // namespace

Pause::Pause(const RenderJob& job, RenderSession& session, Log& log) : job_(job), session_(session), log_(log) {
  if (!job.resume.empty()) start_ = session.readCheckpointOfJob();
}

int Pause::resume(StopRule& rule) {
  if (!start_) return 0;
  session_.restore(*start_);
  const CheckpointBlock* block = start_->find(kTrendName);
  ErrorTrend trend;
  if (block == nullptr || block->bytes.size() != sizeof trend)
    throw SceneError("the checkpoint has no fitting error trend", job_.resume.string(), "start again without --resume");
  std::memcpy(&trend, block->bytes.data(), sizeof trend);
  rule.resume(trend);
  const int passes = start_->passes;
  start_.reset();
  return passes;
}

void Pause::save(const StopRule& rule, int passes, bool isEnd) {
  const auto now = std::chrono::steady_clock::now();
  if (job_.checkpoint.empty() || passes == 0 || (!isEnd && now - lastSave_ < kInterval)) return;
  lastSave_ = now;
  const auto trend = std::as_bytes(std::span(&rule.trend(), 1));
  try {
    writeCheckpoint(job_.checkpoint, session_.save(passes, {{kTrendName, {trend.begin(), trend.end()}}}));
    hasFailed_ = false;
  } catch (const OutputError& error) {
    hasFailed_ = true;
    log_.warn("checkpoint not written", error.what());
  }
}

}  // namespace importon
