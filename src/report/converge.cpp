#include "report/converge.h"

#include <cmath>
#include <map>

#include "base/clock.h"
#include "fmt/format.h"
#include "render/render.h"

namespace importon {
namespace {

std::uint64_t storedOf(const RenderStats& stats) { return stats.caustic.stored + stats.global.stored; }

/// One run, watched: the image of the last pass that ended within each budget.
class Watch {
 public:
  Watch(const ConvergePlan& plan, const Image& reference, const std::string& referenceName)
      : plan_(plan), reference_(reference), referenceName_(referenceName) {}

  void afterPass(const RenderProgress& progress) {
    const double passSeconds = progress.seconds - lastSeconds_;
    lastSeconds_ = progress.seconds;
    lastPass_ = progress.pass;
    if (next_ < plan_.budgets.size() && progress.seconds > plan_.budgets[next_]) keep();
    while (next_ < plan_.budgets.size() && progress.seconds > plan_.budgets[next_]) ++next_;
    if (next_ == plan_.budgets.size()) return;
    constexpr double kCaution = 2;  // the next pass may take that much longer
    if (progress.seconds + kCaution * passSeconds > plan_.budgets[next_]) measure(progress);
  }

  /// What was measured; to be called once, with the result: a last pass that came sooner than expected is in it.
  [[nodiscard]] std::vector<std::pair<ConvergePoint, Image>> take(const RenderResult& result) {
    const bool isMissing = !last_ || last_->first.passes < lastPass_;
    if (next_ < plan_.budgets.size() && isMissing && !result.wasInterrupted)
      enter(result.image, result.stats, lastPass_, lastSeconds_);
    keep();
    return std::move(kept_);
  }

 private:
  void measure(const RenderProgress& progress) {
    const Clock::time_point start = Clock::now();
    Image image = progress.image();
    enter(std::move(image), *progress.stats, progress.pass, progress.seconds + secondsSince(start));
  }
  void enter(Image image, const RenderStats& stats, int passes, double seconds) {
    ConvergePoint point;
    point.budget = plan_.budgets[next_];
    point.seconds = seconds;
    point.passes = passes;
    point.photonsEmitted = stats.photonsEmitted;
    point.photonsStored = storedOf(stats);
    point.errors = compareValues(image, "the image", reference_, referenceName_);
    last_.emplace(point, std::move(image));
  }
  void keep() {
    if (last_) kept_.push_back(std::move(*last_));
    last_.reset();
  }

  const ConvergePlan& plan_;
  const Image& reference_;
  const std::string& referenceName_;
  std::optional<std::pair<ConvergePoint, Image>> last_;  // within the next budget, so far
  std::vector<std::pair<ConvergePoint, Image>> kept_;
  std::size_t next_ = 0;  // budget
  double lastSeconds_ = 0;
  int lastPass_ = 0;
};

/// Seconds and errors of the points for one budget.
std::vector<double> valuesAt(const std::vector<ConvergeRun>& runs, double budget, bool isSeconds) {
  std::vector<double> values;
  for (const ConvergeRun& run : runs) {
    for (const ConvergePoint& point : run.points) {
      if (point.budget == budget) values.push_back(isSeconds ? point.seconds : point.errors.relmseTrimmed);
    }
  }
  return values;
}

std::vector<CurvePoint> curveOf(const ConvergeRun& run) {
  std::vector<CurvePoint> curve;
  for (const ConvergePoint& point : run.points) curve.push_back({point.seconds, point.errors.relmseTrimmed});
  return curve;
}

/// A quarter, half and three quarters of the way from the first to the last error of the first configuration, in
/// logarithms.
std::vector<double> levelsOf(const ConvergeReport& report) {
  if (report.results.empty() || report.results.front().summaries.empty()) return {};
  const auto& summaries = report.results.front().summaries;
  const double first = summaries.front().error.mean, last = summaries.back().error.mean;
  std::vector<double> levels;
  for (const double share : {0.25, 0.5, 0.75}) levels.push_back(first * std::pow(last / first, share));
  return levels;
}

std::optional<Interval> timeTo(double level, const std::vector<ConvergeRun>& runs) {
  std::vector<double> times;
  for (const ConvergeRun& run : runs) {
    const auto time = crossing(curveOf(run), level);
    if (!time) return {};
    times.push_back(*time);
  }
  if (times.empty()) return {};
  return logIntervalOf(times);
}

/// Renders one seed, watched.
RenderResult runOnce(const ConvergePlan& plan, const ConvergeConfig& config, std::uint32_t seed, const Scene& scene,
                     Watch& watch, Log& log, const std::atomic<bool>& isInterrupted) {
  RenderJob job = config.job;
  job.seed = seed;
  job.seconds = plan.budgets.back();
  job.passes.reset();
  job.error.reset();
  job.aovs = {"N", "P", "direct"};  // show plain surfaces
  const auto start =
      Clock::now() - std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(plan.loadSeconds));
  return render(
      job, scene, log, isInterrupted, [&](const RenderProgress& progress) { watch.afterPass(progress); }, start);
}

}  // namespace

void summarize(ConvergeReport& report) {
  for (ConvergeResult& result : report.results) {
    for (ConvergeSummary& summary : result.summaries) {
      summary.seconds = intervalOf(valuesAt(result.runs, summary.budget, true));
      summary.error = intervalOf(valuesAt(result.runs, summary.budget, false));
    }
  }
  report.levels = levelsOf(report);
  for (ConvergeResult& result : report.results) {
    result.timeToError.clear();
    for (const double level : report.levels) result.timeToError.push_back(timeTo(level, result.runs));
  }
}

ConvergeReport converge(const ConvergePlan& plan, const Scene& scene, const Image& reference,
                        const std::string& referenceName, Log& log, const std::atomic<bool>& isInterrupted,
                        const std::function<void(const std::string&)>& tell) {
  ConvergeReport report;
  for (const ConvergeConfig& config : plan.configs) {
    ConvergeResult result{config, {}, {}, {}, {}};
    std::map<double, ErrorSplit> splits;
    for (int seed = 1; seed <= plan.seeds && !isInterrupted; ++seed) {
      tell(fmt::format("{}, seed {} of {}", config.name, seed, plan.seeds));
      Watch watch(plan, reference, referenceName);
      const auto number = static_cast<std::uint32_t>(seed);
      const RenderResult rendered = runOnce(plan, config, number, scene, watch, log, isInterrupted);
      report.deviceName = rendered.stats.deviceName;
      report.deviceDriver = rendered.stats.deviceDriver;
      ConvergeRun run{number, {}, rendered.stats.devicePeakBytes, rendered.stats.photonMapBytes};
      const PlainSurfaces plain = findPlainSurfaces(rendered.image, rendered.image);
      for (auto& [point, image] : watch.take(rendered)) {
        point.band = bandError(image, reference, plain);
        run.points.push_back(point);
        splits[point.budget].add(image);
        if (seed == 1) result.image = std::move(image);
      }
      result.runs.push_back(std::move(run));
    }
    for (const auto& [budget, split] : splits) result.summaries.push_back({budget, {}, {}, split.parts(reference)});
    report.results.push_back(std::move(result));
  }
  summarize(report);
  return report;
}

}  // namespace importon
