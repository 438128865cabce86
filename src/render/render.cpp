#include "render/render.h"

#include <algorithm>

#include "base/clock.h"
#include "render/plan/stop_rule.h"
#include "render/renderer.h"
#include "render/resume/checkpointer.h"

namespace importon {
namespace {

/// A first guess of the seconds that resolving and writing the image takes.
double guessFinish(const RenderJob& job, std::uint64_t pixels) {
  constexpr double kFilterSeconds = 3e-6, kWriteSeconds = 4e-7;  // per pixel; per pixel and layer
  const double layers = 1 + static_cast<double>(job.aovs.size()) + (job.png.empty() ? 0 : 1);
  return static_cast<double>(pixels) * (kWriteSeconds * layers + (job.sharesLight ? kFilterSeconds : 0));
}

RenderProgress describeProgress(const Renderer& renderer, const StopRule& rule, int passes, int maxPasses,
                                double seconds) {
  const RenderStats& stats = renderer.stats();
  const double working = std::max(stats.seconds.photons + stats.seconds.gather, 1e-9);
  RenderProgress p;
  p.pass = passes;
  p.passes = maxPasses;
  p.seconds = seconds;
  p.photonsPerSecond = static_cast<double>(stats.photonsEmitted) / std::max(stats.seconds.photons, 1e-9);
  p.raysPerSecond = static_cast<double>(stats.closestRays + stats.shadowRays) / working;
  p.secondsLeft = rule.secondsLeft(passes, seconds);
  p.error = rule.trend().error;
  p.target = rule.target();
  p.stats = &stats;
  p.image = [&renderer] { return renderer.image(); };
  return p;
}

}  // namespace

RenderResult render(const RenderJob& job, const Scene& scene, Log& log, const std::atomic<bool>& isInterrupted,
                    const std::function<void(const RenderProgress&)>& progress, Clock::time_point start,
                    const RenderSources& sources) {
  Renderer renderer(job, scene, log, sources);
  Checkpointer checkpointer(job, renderer.fingerprint(), log);
  renderer.prepare();
  const int maxPasses = renderer.context().plan.maxPasses;
  StopRule rule(job, maxPasses, guessFinish(job, renderer.context().pixels()));
  const auto state = [&] {
    std::vector<Kept> kept = renderer.state();
    kept.push_back(keep("error trend", rule.trend()));
    return kept;
  };
  int passes = checkpointer.passes();
  if (passes > 0) {
    renderer.prepareState(passes);
    checkpointer.resume(state());
    renderer.stateRestored(passes);
  }
  double outside = 0;  // seconds spent in `progress`
  const auto elapsed = [&] { return secondsSince(start) - outside; };
  for (;;) {
    if (rule.wantsEstimate(passes)) {
      const double estimateStart = elapsed();
      const double error = renderer.estimatedError();
      rule.errorIs(passes, error, elapsed() - estimateStart);
    }
    const int parts = rule.partsOfNext(passes, elapsed());
    if (parts == 0 || isInterrupted) break;
    const double passStart = elapsed();
    renderer.renderPass(passes, parts);
    ++passes;
    rule.passTook(elapsed() - passStart, parts);
    const double outsideStart = elapsed();
    progress(describeProgress(renderer, rule, passes, maxPasses, outsideStart));
    outside += elapsed() - outsideStart;
    checkpointer.save(passes, state, false);
  }
  checkpointer.save(passes, state, true);
  RenderResult result;
  result.wasInterrupted = isInterrupted;
  result.lacksCheckpoint = checkpointer.hasFailed();
  result.image = renderer.imageWithLayers();
  result.stats = renderer.finish(passes);
  return result;
}

}  // namespace importon
