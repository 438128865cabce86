#include "render/film/adaptive_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "scene/light_math.h"

namespace importon {
namespace {

constexpr int kFirstLearning = 4;    // passes: two in each half
constexpr double kEvenPaths = 0.25;  // of all paths, whatever was learned
/// Length of the mean normal of what a pixel sees, below which it sees several surfaces.
constexpr float kOneSurface = 0.98f;
constexpr double kGolden = 0.6180339887498949;  // multiples of it fill [0, 1) evenly

/// False for pixels on edges, with which the filter of indirect light can do little.
bool seesOneSurface(const FilmPixel& p) { return glm::length(p.normal) >= kOneSurface * p.gathers; }

/// Variance of a path's light relative to the squared radiance of its pixel and a hundredth of the image's.
/// `samplesOf`: a pixel's paths in the half.
template <class SamplesOf>
std::vector<double> relativeVariance(std::span<const FilmPixel> half, const SamplesOf& samplesOf, float indirectShare) {
  std::vector<double> radiance(half.size()), variance(half.size());
  for (std::size_t i = 0; i < half.size(); ++i) {
    const FilmPixel& p = half[i];
    const double scale = 1 / static_cast<double>(samplesOf(i)),
                 found = meanOf(p.emitted + p.direct + p.caustic) * scale;
    radiance[i] = found + meanOf(p.indirect) * scale;
    const double ofFound = std::max(static_cast<double>(p.foundSquare) * scale - found * found, 0.0);
    const double ofAll = std::max(meanOf(p.square) * scale - radiance[i] * radiance[i], 0.0);
    variance[i] = ofFound + static_cast<double>(seesOneSurface(p) ? indirectShare : 1) * std::max(ofAll - ofFound, 0.0);
  }
  const double mean = std::accumulate(radiance.begin(), radiance.end(), 0.0) / static_cast<double>(half.size());
  for (std::size_t i = 0; i < half.size(); ++i)
    variance[i] /= std::max(radiance[i] * radiance[i] + 0.01 * mean * mean, 1e-300);
  return variance;
}

/// Mean over each pixel and its eight neighbours.
std::vector<double> smooth(const std::vector<double>& values, int width) {
  const int height = static_cast<int>(values.size()) / width;
  std::vector<double> out(values.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      int count = 0;
      for (int qy = std::max(y - 1, 0); qy <= std::min(y + 1, height - 1); ++qy)
        for (int qx = std::max(x - 1, 0); qx <= std::min(x + 1, width - 1); ++qx, ++count)
          sum += values[static_cast<std::size_t>(qy) * static_cast<std::size_t>(width) + static_cast<std::size_t>(qx)];
      out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = sum / count;
    }
  }
  return out;
}

/// Shares by the root of the variance, within limits; mean 1.
std::vector<float> sharesOf(const std::vector<double>& variance) {
  std::vector<double> shares(variance.size());
  std::transform(variance.begin(), variance.end(), shares.begin(), [](double v) { return std::sqrt(v); });
  const auto meanShare = [&] {
    return std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(shares.size());
  };
  double mean = meanShare();
  if (!(mean > 0)) return std::vector<float>(variance.size(), 1.0f);
  for (double& share : shares)
    share = std::min(kEvenPaths + (1 - kEvenPaths) * share / mean, static_cast<double>(kMostPathsShare));
  return {shares.begin(), shares.end()};
}

}  // namespace

AdaptiveSampler::AdaptiveSampler(int width, std::size_t pixels) : width_(width), pixels_(pixels) {}

bool AdaptiveSampler::learnsBefore(int pass) {
  return pass >= kFirstLearning && std::has_single_bit(static_cast<unsigned>(pass));
}

void AdaptiveSampler::learn(std::span<const FilmPixel> halves, std::uint64_t evenSamples, std::uint64_t oddSamples,
                            float indirectShare) {
  const SampleCounts counts = this->counts(evenSamples, oddSamples);
  const auto even = [&](std::size_t i) { return counts.even(i); };
  const auto odd = [&](std::size_t i) { return counts.odd(i); };
  shares_[0] = sharesOf(smooth(relativeVariance(halves.last(pixels_), odd, indirectShare), width_));
  shares_[1] = sharesOf(smooth(relativeVariance(halves.first(pixels_), even, indirectShare), width_));
  for (std::vector<std::int32_t>& extra : extra_) extra.resize(pixels_);
}

std::vector<uvec2> AdaptiveSampler::distribute(int pass, std::uint32_t samples, std::size_t first, std::size_t count) {
  const std::span<const float> shares(shares_[pass % 2].data() + first, count);
  const std::span<std::int32_t> extra(extra_[pass % 2].data() + first, count);
  // Sums of shares are rounded up or down alike within a pass, and otherwise in the next.
  const int passOfHalf = pass / 2;
  const double offset = std::fmod(passOfHalf * kGolden, 1.0);
  const double whole = static_cast<double>(samples) * static_cast<double>(count) - 1;
  const double scale = pixels_ == count ? whole / std::accumulate(shares.begin(), shares.end(), 0.0) : samples;
  std::vector<uvec2> firstPaths;
  firstPaths.reserve(count + 1);
  double sum = offset;
  for (std::size_t i = 0; i < count; ++i) {
    const auto begin = static_cast<uint>(sum);
    const std::int32_t beyond = extra_[0][first + i] + extra_[1][first + i];
    firstPaths.emplace_back(begin, static_cast<uint>(beyond));
    sum += scale * static_cast<double>(shares[i]);
    extra[i] += static_cast<std::int32_t>(static_cast<uint>(sum) - begin) - static_cast<std::int32_t>(samples);
  }
  firstPaths.emplace_back(static_cast<uint>(sum), 0);
  return firstPaths;
}

SampleCounts AdaptiveSampler::counts(std::uint64_t evenSamples, std::uint64_t oddSamples) const {
  return {evenSamples, oddSamples, extra_[0], extra_[1]};
}

std::vector<std::byte> AdaptiveSampler::save() const {
  std::vector<std::byte> bytes;
  for (int half = 0; half < 2; ++half) {
    const auto shares = std::as_bytes(std::span(shares_[half])), extra = std::as_bytes(std::span(extra_[half]));
    bytes.insert(bytes.end(), shares.begin(), shares.end());
    bytes.insert(bytes.end(), extra.begin(), extra.end());
  }
  return bytes;
}

bool AdaptiveSampler::restore(std::span<const std::byte> bytes) {
  const bool hasLearned = !bytes.empty();
  if (hasLearned && bytes.size() != 2 * pixels_ * (sizeof(float) + sizeof(std::int32_t))) return false;
  const auto take = [&](auto& values) {
    values.resize(hasLearned ? pixels_ : 0);
    const auto target = std::as_writable_bytes(std::span(values));
    std::copy_n(bytes.begin(), target.size(), target.begin());
    bytes = bytes.subspan(target.size());
  };
  for (int half = 0; half < 2; ++half) {
    take(shares_[half]);
    take(extra_[half]);
  }
  return true;
}

}  // namespace importon
