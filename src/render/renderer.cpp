#include "render/renderer.h"

#include <algorithm>

#include "render/render_session.h"

namespace importon {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// True when the job asks for no more passes. `lastPassSeconds` is how long one takes.
bool isDone(const RenderJob& job, RenderSession& session, int passes, double seconds, double lastPassSeconds) {
  if (passes >= session.maxPasses()) return true;
  if (passes == 0) return false;
  if (job.seconds && seconds + lastPassSeconds > *job.seconds) return true;
  if (job.passes || (job.seconds && !job.error)) return false;
  if (passes < 4 || passes % 2 != 0) return false;  // the halves must hold equally many passes
  session.stats().error.estimated = session.estimatedError(passes);
  return *session.stats().error.estimated <= job.error.value_or(kDefaultError);
}

RenderProgress describeProgress(const RenderJob& job, RenderSession& session, int passes, double seconds,
                                double passSeconds) {
  const RenderStats& stats = session.stats();
  const double working = std::max(stats.seconds.photons + stats.seconds.gather, 1e-9);
  RenderProgress p;
  p.pass = passes;
  p.passes = session.maxPasses();
  p.seconds = seconds;
  p.photonsPerSecond = static_cast<double>(stats.photonsEmitted) / std::max(stats.seconds.photons, 1e-9);
  p.raysPerSecond = static_cast<double>(stats.closestRays + stats.shadowRays) / working;
  p.secondsLeft = job.seconds ? std::max(0.0, *job.seconds - seconds) : passSeconds * (p.passes - passes);
  return p;
}

}  // namespace

RenderResult render(const RenderJob& job, const Scene& scene, Log& log, const std::atomic<bool>& isInterrupted,
                    const std::function<void(const RenderProgress&)>& progress, Clock::time_point start) {
  RenderSession session(job, scene, log);
  if (session.hasMaps()) session.findImportance();
  int passes = 0;
  double passSeconds = 0;
  while (!isDone(job, session, passes, secondsSince(start), passSeconds) && !isInterrupted) {
    const Clock::time_point passStart = Clock::now();
    session.shootPhotons(passes);
    session.gatherImage(passes);
    session.countPass(passes);
    ++passes;
    passSeconds = secondsSince(passStart);
    progress(describeProgress(job, session, passes, secondsSince(start), passSeconds));
  }
  RenderResult result;
  result.wasInterrupted = isInterrupted;
  result.image = session.resolve(passes);
  session.finishStats(passes);
  result.stats = session.stats();
  return result;
}

}  // namespace importon
