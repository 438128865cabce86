#include "render/render.h"

#include <algorithm>

#include "base/clock.h"
#include "render/resume/checkpointer.h"
#include "render/team.h"

namespace importon {
namespace {

/// What `stats` points to must last as long.
RenderProgress describeProgress(Team& team, const RenderStats& stats, double seconds) {
  const double working = std::max(stats.seconds.photons + stats.seconds.gather, 1e-9);
  RenderProgress p;
  p.pass = team.passes();
  p.passes = team.maxPasses();
  p.seconds = seconds;
  p.photonsPerSecond = static_cast<double>(stats.photonsEmitted) / std::max(stats.seconds.photons, 1e-9);
  p.raysPerSecond = static_cast<double>(stats.closestRays + stats.shadowRays) / working;
  p.secondsLeft = team.secondsLeft(seconds);
  p.error = team.rule().trend().error;
  p.target = team.rule().target();
  p.stats = &stats;
  p.image = [&team] { return team.image(); };
  return p;
}

}  // namespace

RenderResult render(const RenderJob& job, const Scene& scene, Log& log, const std::atomic<bool>& isInterrupted,
                    const std::function<void(const RenderProgress&)>& progress, Clock::time_point start,
                    const RenderSources& sources) {
  Team team(job, scene, log, sources);
  Checkpointer checkpointer(job, team.fingerprint(), log);
  team.prepare();
  if (const std::optional<Checkpoint> checkpoint = checkpointer.takeStart()) team.restore(*checkpoint, job.resume);
  double outside = 0;  // seconds spent in `progress`
  const auto elapsed = [&] { return secondsSince(start) - outside; };
  const auto save = [&](bool isEnd) {
    checkpointer.save(
        team.passes(), [&team] { return team.blocks(); }, isEnd);
  };
  for (;;) {
    team.estimate(elapsed);
    if (isInterrupted || !team.renderRound(elapsed, isInterrupted)) break;
    const double outsideStart = elapsed();
    const RenderStats stats = team.stats();
    progress(describeProgress(team, stats, outsideStart));
    outside += elapsed() - outsideStart;
    save(false);
  }
  save(true);
  const bool wasInterrupted = isInterrupted;
  RenderResult result = team.finish();
  result.wasInterrupted = wasInterrupted;
  result.lacksCheckpoint = checkpointer.hasFailed();
  return result;
}

}  // namespace importon
