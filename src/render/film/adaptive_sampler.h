/// How many camera paths each pixel gets: more where the image is noisier.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/plan/sample_counts.h"
#include "shared/render_data.h"

namespace importon {

/// Shares out the paths of a pass by the noise per pixel that earlier passes show. How many paths a half of the film
/// gets where depends on the other half alone: a half's mean over its own paths stays unbiased, whatever their number.
class AdaptiveSampler {
 public:
  AdaptiveSampler(int width, std::size_t pixels);

  /// True before passes whose number is a power of two, from the fourth on.
  [[nodiscard]] static bool learnsBefore(int pass);
  /// Shares follow the film's `halves` (even, then odd passes) from now on: the root of the relative variance of
  /// emitted, direct and caustic light, and of `indirectShare` of that of indirect light (the whole on edges, where it
  /// is shared with few pixels), over 3 x 3 pixels; a part is even.
  void learn(std::span<const FilmPixel> halves, std::uint64_t evenSamples, std::uint64_t oddSamples,
             float indirectShare);
  [[nodiscard]] bool hasLearned() const { return !shares_[0].empty(); }

  /// Deals `samples` paths per pixel in the mean, to the pixels `first` .. `first + count`; adds them to the counts.
  /// Returns for each pixel the first of its paths among these, and that path's number among all of the pixel's beyond
  /// those of the mean; then the number of paths in all.
  [[nodiscard]] std::vector<uvec2> distribute(int pass, std::uint32_t samples, std::size_t first, std::size_t count);
  [[nodiscard]] SampleCounts counts(std::uint64_t evenSamples, std::uint64_t oddSamples) const;

  /// What lasts while a render pauses.
  [[nodiscard]] std::vector<std::byte> save() const;
  /// False if `bytes` are not those of a plan for as many pixels.
  [[nodiscard]] bool restore(std::span<const std::byte> bytes);

 private:
  int width_;
  std::size_t pixels_;
  std::vector<float> shares_[2];        // of even and odd passes; mean 1
  std::vector<std::int32_t> extra_[2];  // paths of each pixel beyond the mean
};

}  // namespace importon
