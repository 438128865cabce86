#include "render/team.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <numeric>

#include "base/clock.h"
#include "base/hash.h"
#include "gpu/device_choice.h"
#include "render/film/error_estimate.h"
#include "render/plan/device_shares.h"

namespace importon {
namespace {

constexpr double kPassesOfRound = 4;  // of the slowest device, with a time budget: the others wait less than a pass

/// A first guess of the seconds that resolving and writing the image takes.
double guessFinish(const RenderJob& job, std::uint64_t pixels) {
  constexpr double kFilterSeconds = 3e-6, kWriteSeconds = 4e-7;  // per pixel; per pixel and layer
  const double layers = 1 + static_cast<double>(job.aovs.size()) + (job.png.empty() ? 0 : 1);
  return static_cast<double>(pixels) * (kWriteSeconds * layers + (job.sharesLight ? kFilterSeconds : 0));
}

/// Those of the job that the passes are enough for.
std::vector<std::unique_ptr<Member>> membersOf(const RenderJob& job) {
  std::vector<std::string> devices = gpu::devicesNamed(job.device);
  if (job.passes) devices.resize(std::min(devices.size(), static_cast<std::size_t>(*job.passes)));
  std::vector<std::unique_ptr<Member>> members;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    members.push_back(std::make_unique<Member>(Member{job, i}));
    Member& member = *members.back();
    member.job.device = devices[i];
    member.job.seed = seedOfDevice(job.seed, i);
    if (devices.size() > 1) member.prefix = fmt::format("device {}: ", i);
  }
  return members;
}

/// The mean of images of the same channels, with weights.
class ImageMean {
 public:
  void add(Image image, double weight) {
    sums_.resize(image.channels.size());
    for (std::size_t c = 0; c < sums_.size(); ++c) {
      const std::vector<float>& values = image.channels[c].values;
      sums_[c].resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) sums_[c][i] += weight * static_cast<double>(values[i]);
    }
    weight_ += weight;
    last_ = std::move(image);
  }
  [[nodiscard]] Image result() && {
    for (std::size_t c = 0; c < sums_.size(); ++c)
      std::ranges::transform(sums_[c], last_.channels[c].values.begin(),
                             [this](double sum) { return static_cast<float>(sum / weight_); });
    return std::move(last_);
  }

 private:
  std::vector<std::vector<double>> sums_;
  double weight_ = 0;
  Image last_;
};

}  // namespace

int Member::render(const Elapsed& elapsed, double end, const std::atomic<bool>& isInterrupted) {
  int made = 0;
  for (double start = elapsed(); made == 0 || start + rule->passSeconds() <= end; start = elapsed()) {
    const int parts = rule->partsOfNext(passes, start);
    if (parts == 0 || isInterrupted) break;
    renderer->renderPass(passes, parts);
    ++passes;
    ++made;
    rule->passTook(elapsed() - start, parts);
  }
  return made;
}

std::vector<Kept> Member::state() {
  std::vector<Kept> state = renderer->state();
  state.push_back(keep("error trend", rule->trend()));
  for (Kept& kept : state) kept.name = prefix + kept.name;
  return state;
}

Team::Team(const RenderJob& job, const Scene& scene, Log& log, const RenderSources& sources)
    : job_(job), log_(log), members_(membersOf(job)) {
  const auto build = [&] { return sources.tree ? sources.tree() : buildSceneBvh(scene, job, log, treeSeconds_); };
  const std::shared_future tree = std::async(std::launch::deferred, build).share();  // by whoever asks first
  onEach([&](Member& member) {
    const RenderSources own{sources.device, [tree] { return tree.get(); }};
    member.renderer = std::make_unique<Renderer>(member.job, scene, log, own);
  });
  const PassContext& context = members_.front()->renderer->context();
  maxPasses_ = context.plan.maxPasses;
  ContentHash hash;
  for (const auto& member : members_) {
    member->rule.emplace(job, maxPasses_, guessFinish(job, context.pixels()));
    fingerprint_ = member->renderer->fingerprint();
    hash.add(fmt::format("{} ", fingerprint_));
  }
  if (members_.size() > 1) fingerprint_ = hash.value();
}

void Team::prepare() {
  onEach([](Member& member) { member.renderer->prepare(); });
}

void Team::restore(const Checkpoint& checkpoint, const std::filesystem::path& file) {
  onEach([&](Member& member) {
    const Kept passes = keep(member.prefix + "passes", member.passes);
    if (!member.prefix.empty() && checkpoint.find(passes.name) == nullptr) return;
    importon::restore({passes}, checkpoint, file);
    member.renderer->prepareState(member.passes);
    importon::restore(member.state(), checkpoint, file);
    member.renderer->stateRestored(member.passes);
  });
}

std::vector<CheckpointBlock> Team::blocks() {
  std::vector<CheckpointBlock> blocks;
  inTurn([&](Member& member) {
    std::vector<Kept> state = member.state();
    state.push_back(keep(member.prefix + "passes", member.passes));
    for (CheckpointBlock& block : blocksOf(state)) blocks.push_back(std::move(block));
  });
  return blocks;
}

void Team::estimate(const Elapsed& elapsed) {
  sharePasses();
  const auto wants = [](const auto& member) { return member->rule->wantsEstimate(member->passes); };
  if (!areLevel() || std::ranges::none_of(members_, wants)) return;
  const double start = elapsed();
  FilmSums film;
  const double error = resolve(film).estimatedError;
  for (const auto& member : members_) member->rule->errorIs(member->passes, error, elapsed() - start);
}

bool Team::renderRound(const Elapsed& elapsed, const std::atomic<bool>& isInterrupted) {
  const std::size_t devices = members_.size();
  sharePasses();
  double end = 0;
  if (job_.seconds && devices > 1)
    for (const auto& member : members_) end = std::max(end, elapsed() + kPassesOfRound * member->rule->passSeconds());
  std::atomic<int> made = 0;
  const bool areAllToRender = areLevel();
  std::vector<const Member*> waiting;
  for (const auto& member : members_)
    if (!areAllToRender && !isBehind(*member)) waiting.push_back(member.get());
  onEach([&](Member& member) {
    if (std::ranges::find(waiting, &member) == waiting.end()) made += member.render(elapsed, end, isInterrupted);
  });
  return made > 0 || members_.size() < devices;
}

int Team::passes() const {
  return std::accumulate(members_.begin(), members_.end(), 0,
                         [](int sum, const auto& member) { return sum + member->passes; });
}

void Team::sharePasses() {
  std::vector<int> done;
  for (const auto& member : members_) done.push_back(member->passes);
  const std::vector<int> shares = importon::sharePasses(maxPasses_, done, job_.seconds.has_value());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i]->share = shares[i];
    members_[i]->rule->setMaxPasses(shares[i]);
  }
}

/// Of those that keep step, as they do without a time budget: after an interrupt, one may have made a pass less.
bool Team::isBehind(const Member& member) const {
  if (job_.seconds || member.passes == member.share) return false;
  return std::ranges::any_of(members_, [&](const auto& other) { return other->passes > member.passes; });
}

bool Team::areLevel() const {
  return std::ranges::none_of(members_, [this](const auto& member) { return isBehind(*member); });
}

double Team::secondsLeft(double elapsed) const {
  double left = -1;
  for (const auto& member : members_) left = std::max(left, member->rule->secondsLeft(member->passes, elapsed));
  return left;
}

RenderStats Team::stats() const {
  std::vector<RenderStats> all;
  for (const auto& member : members_) all.push_back(member->renderer->stats());
  return sumOf(all);
}

/// The halves of every second device change places: a pass on each of two devices makes both. A single half is even.
FilmSums Team::film() {
  FilmSums sum;
  inTurn([&](Member& member) {
    if (member.passes == 0 && passes() > 0) return;
    FilmSums own = member.renderer->film();
    own.passes = member.passes;
    own.seeds = {member.job.seed};
    if (member.position % 2 == 1) own.swapHalves();
    if (sum.halves.empty())
      sum = std::move(own);
    else
      sum.add(own, job_.threads);
  });
  if (sum.evenSamples == 0) sum.swapHalves();
  return sum;
}

/// Leaves the film without pixels.
FilmLayers Team::resolve(FilmSums& film) {
  const Clock::time_point start = Clock::now();
  film = this->film();
  FilmLayers layers = members_.front()->renderer->resolve(film);
  film.halves = {};
  resolveSeconds_ += secondsSince(start);
  return layers;
}

Image Team::image() {
  const FilmLayers layers = members_.front()->renderer->resolve(film());
  return members_.front()->renderer->image(layers);
}

Image Team::imageWithLayers(const FilmLayers& layers) {
  if (job_.aovs.empty()) return members_.front()->renderer->image(layers);
  ImageMean mean;
  inTurn([&](Member& member) {
    const bool isEmpty = member.passes == 0 && passes() > 0;
    if (!isEmpty) mean.add(member.renderer->imageWithLayers(layers), std::max(member.passes, 1));
  });
  return std::move(mean).result();
}

RenderResult Team::finish() {
  RenderResult result;
  FilmSums film;
  const FilmLayers layers = resolve(film);
  result.image = imageWithLayers(layers);
  std::vector<RenderStats> all;
  inTurn([&](Member& member) { all.push_back(member.renderer->finish(member.passes)); });
  result.stats = sumOf(all);
  result.stats.passes = static_cast<int>(film.passes);
  result.stats.seconds.bvh += treeSeconds_;
  result.stats.seconds.resolve += resolveSeconds_;
  result.seeds = std::move(film.seeds);
  if (film.oddSamples > 0) {
    result.stats.error.estimated = layers.estimatedError;
    result.stats.error.low = kBandLow * layers.estimatedError;
    result.stats.error.high = kBandHigh * layers.estimatedError;
  }
  return result;
}

void Team::onEach(const Work& work) {
  std::vector<std::exception_ptr> errors(members_.size());
  const auto run = [&](std::size_t i) {
    try {
      work(*members_[i]);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  };
  std::vector<std::future<void>> others;
  for (std::size_t i = 1; i < members_.size(); ++i) others.push_back(std::async(std::launch::async, run, i));
  run(0);
  for (std::future<void>& other : others) other.get();
  dropFailed(errors);
}

void Team::inTurn(const Work& work) {
  std::vector<std::exception_ptr> errors(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    try {
      work(*members_[i]);
    } catch (const DeviceError&) {
      errors[i] = std::current_exception();
    }
  }
  dropFailed(errors);
}

void Team::dropFailed(std::span<const std::exception_ptr> errors) {
  std::size_t left = members_.size();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i]) continue;
    try {
      std::rethrow_exception(errors[i]);
    } catch (const DeviceError& error) {
      if (--left == 0) throw;
      const Member& lost = *members_[i];
      log_.warn("failure of device " + lost.job.device,
                fmt::format("{} (device {}): what it made is left out (passes: {}), and the other devices go on",
                            error.problem(), lost.job.device, lost.passes));
      members_[i].reset();
    }
  }
  std::erase(members_, nullptr);
}

}  // namespace importon
