#include "render/renderer.h"

#include <algorithm>

#include "base/clock.h"
#include "render/pause.h"
#include "render/render_session.h"
#include "render/stop_rule.h"

namespace importon {
namespace {

/// A first guess of the seconds that resolving and writing the image takes.
double guessFinish(const RenderJob& job, const RenderSession& session) {
  constexpr double kFilterSeconds = 1.5e-6, kWriteSeconds = 4e-7;  // per pixel; per pixel and layer
  const double layers = 1 + static_cast<double>(job.aovs.size()) + (job.png.empty() ? 0 : 1);
  return static_cast<double>(session.pixels()) * (kWriteSeconds * layers + (job.filtersIndirect ? kFilterSeconds : 0));
}

RenderProgress describeProgress(RenderSession& session, const StopRule& rule, int passes, double seconds) {
  const RenderStats& stats = session.stats();
  const double working = std::max(stats.seconds.photons + stats.seconds.gather, 1e-9);
  RenderProgress p;
  p.pass = passes;
  p.passes = session.maxPasses();
  p.seconds = seconds;
  p.photonsPerSecond = static_cast<double>(stats.photonsEmitted) / std::max(stats.seconds.photons, 1e-9);
  p.raysPerSecond = static_cast<double>(stats.closestRays + stats.shadowRays) / working;
  p.secondsLeft = rule.secondsLeft(passes, seconds);
  p.error = rule.trend().error;
  p.target = rule.target();
  p.stats = &stats;
  p.image = [&session] { return session.resolveColor(); };
  return p;
}

}  // namespace

RenderResult render(const RenderJob& job, const Scene& scene, Log& log, const std::atomic<bool>& isInterrupted,
                    const std::function<void(const RenderProgress&)>& progress, Clock::time_point start,
                    const DeviceSource& deviceSource) {
  RenderSession session(job, scene, log, deviceSource);
  Pause pause(job, session, log);
  if (session.hasMaps()) session.findImportance();
  StopRule rule(job, session.maxPasses(), guessFinish(job, session));
  int passes = pause.resume(rule);
  double outside = 0;  // seconds spent in `progress`
  const auto elapsed = [&] { return secondsSince(start) - outside; };
  for (;;) {
    if (rule.wantsEstimate(passes)) {
      const double estimateStart = elapsed();
      const double error = session.estimatedError();
      rule.errorIs(passes, error, elapsed() - estimateStart);
    }
    const int parts = rule.partsOfNext(passes, elapsed());
    if (parts == 0 || isInterrupted) break;
    const double passStart = elapsed();
    session.shootPhotons(passes, parts);
    session.gatherImage(passes);
    session.countPass(passes);
    ++passes;
    rule.passTook(elapsed() - passStart, parts);
    const double outsideStart = elapsed();
    progress(describeProgress(session, rule, passes, outsideStart));
    outside += elapsed() - outsideStart;
    pause.save(rule, passes, false);
  }
  pause.save(rule, passes, true);
  RenderResult result;
  result.wasInterrupted = isInterrupted;
  result.lacksCheckpoint = pause.hasFailed();
  result.image = session.resolve();
  session.finishStats(passes);
  result.stats = session.stats();
  return result;
}

}  // namespace importon
