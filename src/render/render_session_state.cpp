// Saving and restoring a render in progress.
#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "base/hash.h"
#include "fmt/format.h"
#include "render/job_fingerprint.h"
#include "render/render_session.h"

namespace importon {
namespace {

/// What lasts from pass to pass on the host: sums of the statistics, and how hard a lack of memory made control.
struct HostState {
  std::uint64_t closestRays, shadowRays, photonsEmitted;
  PhotonMapStats caustic, global;
  PassSums done;
  float densityLimit;
  DensityControl control;
};
constexpr const char *kHostName = "host", *kSamplePlanName = "sample plan";

CheckpointBlock blockOf(const std::string& name, std::span<const std::byte> bytes) {
  return {name, {bytes.begin(), bytes.end()}};
}

}  // namespace

std::vector<RenderSession::Lasting> RenderSession::lastingMemory() {
  std::vector<Lasting> lasting;
  for (FilmTile& tile : film_->tiles()) lasting.push_back({fmt::format("film {}", tile.first), &tile.pixels});
  if (!hasMaps()) return lasting;
  lasting.push_back({"caustic importon hits", &importance_.caustic.hits});
  lasting.push_back({"global importon hits", &importance_.global.hits});
  lasting.push_back({"lights seen", &work_->lightsSeen});
  if (irradiance_)
    for (gpu::Buffer* buffer : irradiance_->memory()) lasting.push_back({fmt::format("irradiance {}", lasting.size()), buffer});
  if (causticGuide_) lasting.push_back({"caustic guide", &causticGuide_->memory()});
  if (globalGuide_) lasting.push_back({"global guide", &globalGuide_->memory()});
  return lasting;
}

std::uint64_t RenderSession::runFingerprint() const {
  ContentHash hash;
  hash.add(fmt::format("{} {} {} {}", imageFingerprint(job_, scene_), job_.seed, device_->context.info().name,
                       device_->context.info().driver));
  return hash.value();
}

Checkpoint RenderSession::save(int passes, std::vector<CheckpointBlock> more) {
  Checkpoint checkpoint{runFingerprint(), passes, std::move(more)};
  for (const Lasting& lasting : lastingMemory()) {
    checkpoint.blocks.push_back({lasting.name, std::vector<std::byte>(lasting.buffer->bytes())});
    lasting.buffer->downloadBytes(checkpoint.blocks.back().bytes);
  }
  const HostState host{stats_.closestRays, stats_.shadowRays, stats_.photonsEmitted,          stats_.caustic,
                       stats_.global,      done_, parameters_.globalMap.densityLimit, control_};
  checkpoint.blocks.push_back(blockOf(kHostName, std::as_bytes(std::span(&host, 1))));
  checkpoint.blocks.push_back({kSamplePlanName, samplePlan_.save()});
  return checkpoint;
}

Checkpoint RenderSession::readCheckpointOfJob() const {
  Checkpoint checkpoint = readCheckpoint(job_.resume);
  if (checkpoint.fingerprint != runFingerprint())
    throw SceneError("the checkpoint is of another run", job_.resume.string(),
                     "give the scene, seed, size, settings and device that it was made with");
  return checkpoint;
}

void RenderSession::restore(const Checkpoint& checkpoint) {
  const auto refuse = [&](const std::string& name) {
    throw SceneError("the checkpoint has no fitting " + name, job_.resume.string(), "start again without --resume");
  };
  const auto bytesOf = [&](const std::string& name, std::uint64_t size) -> std::span<const std::byte> {
    const CheckpointBlock* block = checkpoint.find(name);
    if (block == nullptr || block->bytes.size() != size) refuse(name);
    return block->bytes;
  };
  if (features_.readsCells) {
    prepareCells(std::max(checkpoint.passes - 1, 0));
    irradiance_->setPasses(checkpoint.passes);
  }
  for (const Lasting& lasting : lastingMemory())
    lasting.buffer->uploadBytes(bytesOf(lasting.name, lasting.buffer->bytes()));
  for (int pass = 0; pass < std::min(checkpoint.passes, kLearningPasses); ++pass) updateGuides();
  const CheckpointBlock* plan = checkpoint.find(kSamplePlanName);
  if (plan == nullptr || !samplePlan_.restore(plan->bytes)) refuse(kSamplePlanName);
  HostState host{};
  std::memcpy(static_cast<void*>(&host), bytesOf(kHostName, sizeof host).data(), sizeof host);
  stats_.closestRays = host.closestRays;
  stats_.shadowRays = host.shadowRays;
  stats_.photonsEmitted = host.photonsEmitted;
  stats_.caustic = host.caustic;
  stats_.global = host.global;
  done_ = host.done;
  parameters_.globalMap.densityLimit = parameters_.causticMap.densityLimit = host.densityLimit;
  control_ = host.control;
}

}  // namespace importon
