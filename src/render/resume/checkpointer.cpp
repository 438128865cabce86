#include "render/resume/checkpointer.h"

#include "base/error.h"

namespace importon {
namespace {

constexpr std::chrono::seconds kInterval{60};

}  // namespace

Checkpointer::Checkpointer(const RenderJob& job, std::uint64_t fingerprint, Log& log)
    : job_(job), fingerprint_(fingerprint), log_(log) {
  if (job.resume.empty()) return;
  start_ = readCheckpoint(job.resume);
  if (start_->fingerprint != fingerprint)
    throw SceneError("the checkpoint is of another run", job.resume.string(),
                     "give the scene, seed, size, settings and device that it was made with");
}

void Checkpointer::save(int passes, const std::function<std::vector<CheckpointBlock>()>& state, bool isEnd) {
  const auto now = std::chrono::steady_clock::now();
  if (job_.checkpoint.empty() || passes == 0 || (!isEnd && now - lastSave_ < kInterval)) return;
  lastSave_ = now;
  try {
    writeCheckpoint(job_.checkpoint, {fingerprint_, passes, state()});
    hasFailed_ = false;
  } catch (const OutputError& error) {
    hasFailed_ = true;
    log_.warn("checkpoint not written", error.what());
  }
}

}  // namespace importon
