#include "render/camera/camera_pass.h"

#include <fmt/format.h>

#include <algorithm>

namespace importon {
namespace {

/// Of the variance of indirect light, if the filter shares it among pixels.
constexpr float kFilteredShare = 1.0f / 128;

}  // namespace

CameraPass::CameraPass(PassContext& context)
    : context_(context),
      film_(context.device->context, context.pixels(), context.plan.tilePixels),
      sampler_(static_cast<int>(context.parameters.width), context.pixels()) {}

void CameraPass::gather(int pass, const PassSums& before, const EyeMaps& maps) {
  const PassPlan& plan = context_.plan;
  const std::uint32_t samples = context_.now.samples;
  if (plan.isAdaptive && AdaptiveSampler::learnsBefore(pass))
    sampler_.learn(film_.download(), before.evenSamples, before.oddSamples,
                   context_.job.sharesLight ? kFilteredShare : 1.0f);
  for (FilmTile& tile : film_.tiles()) {
    const auto trace = [&](const EyeSamples& some) {
      traceImage(context_.stage(), maps, some, tile.first, tile.count, context_.parameters.maxDepth, tile.pixels,
                 pass % 2 == 0 ? 0 : tile.count);
    };
    if (sampler_.hasLearned()) {
      const std::vector<uvec2> firstPaths = sampler_.distribute(pass, samples, tile.first, tile.count);
      tile.plan = gpu::makeBuffer(context_.device->context, "sample plan", std::span<const uvec2>(firstPaths),
                                  gpu::TexelFormat::uint2);
      const uint paths = firstPaths.back().x, most = tile.count * plan.samplesAtOnce;
      for (uint first = 0; first < paths; first += most) trace({first, std::min(most, paths - first), &tile.plan});
      continue;
    }
    for (uint first = 0; first < samples; first += plan.samplesAtOnce)
      trace({first, std::min(plan.samplesAtOnce, samples - first)});
  }
  context_.recorder.submitAndWait();
}

FilmSums CameraPass::read(const PassSums& done) const {
  const SampleCounts counts = sampler_.counts(done.evenSamples, done.oddSamples);
  FilmSums sums;
  sums.halves = film_.download();
  sums.evenSamples = counts.evenSamples;
  sums.oddSamples = counts.oddSamples;
  sums.evenExtra.assign(counts.evenExtra.begin(), counts.evenExtra.end());
  sums.oddExtra.assign(counts.oddExtra.begin(), counts.oddExtra.end());
  return sums;
}

std::vector<float> CameraPass::traceAovs(const EyeMaps& maps) const {
  std::vector<float> values(context_.pixels() * kAovFloats);
  for (const FilmTile& tile : film_.tiles()) {
    const gpu::Buffer buffer(context_.device->context, "AOVs", std::uint64_t{tile.count} * kAovFloats * sizeof(float));
    importon::traceAovs(context_.stage(), maps, tile.first, tile.count, buffer);
    context_.recorder.submitAndWait();
    buffer.downloadBytes(std::as_writable_bytes(
        std::span(values).subspan(std::size_t{tile.first} * kAovFloats, std::size_t{tile.count} * kAovFloats)));
  }
  return values;
}

void CameraPass::addKept(std::vector<Kept>& state) {
  for (FilmTile& tile : film_.tiles()) state.push_back(keep(fmt::format("film {}", tile.first), tile.pixels));
  state.push_back({"sample plan", [this] { return sampler_.save(); },
                   [this](std::span<const std::byte> bytes) { return sampler_.restore(bytes); }});
}

}  // namespace importon
