/// Averages runs of one image with different seeds.
#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "io/image.h"

namespace importon {

/// The attribute that holds the trimmed relMSE by which noise keeps a merged image from what its runs converge to. The
/// scatter of the runs tells it; a bias that all of them share is not in it.
constexpr const char* kOwnError = "importon:own_error";

/// Takes images one by one, so that only the sum is in memory.
class ImageMerger {
 public:
  /// `image` must be what `importon render` or `merge` wrote: its attributes hold the job, its seeds, separated by
  /// spaces, and its passes. SceneError naming `name` where they are missing, where the job, size or layers are
  /// not those of the images before, or where a seed is there already: its noise would count twice.
  void add(const Image& image, const std::string& name);

  /// Every layer averaged with the passes as weights; `variance`, being that of a mean, with their squares, and
  /// `error` as its root. The attributes are those of the first image, with all seeds, the sum of the passes, and
  /// of two images or more the error of their mean: kOwnError.
  [[nodiscard]] Image result() const;

 private:
  void start(const Image& image, const std::string& name);
  void check(const Image& image, const std::string& name) const;
  [[nodiscard]] double ownError(const Image& mean) const;

  Image first_;  // without values
  std::string firstName_;
  std::vector<std::vector<double>> sums_, squares_;  // squares_: of the channels R, G, B, in the order of the file
  int images_ = 0;
  std::set<std::uint64_t> seeds_;
  double passes_ = 0;
};

}  // namespace importon
