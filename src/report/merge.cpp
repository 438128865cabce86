#include "report/merge.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "fmt/format.h"
#include "fmt/ranges.h"
#include "report/compare.h"

namespace importon {
namespace {

constexpr const char* kSeeds = "importon:seed";
constexpr const char* kPasses = "importon:passes";
constexpr const char* kJob = "importon:job";

const std::string& attributeOf(const Image& image, const std::string& attribute, const std::string& name) {
  const auto found = image.attributes.find(attribute);
  if (found != image.attributes.end()) return found->second;
  throw SceneError(fmt::format("the image has no attribute {}", attribute), name,
                   "merge images that importon has rendered");
}

std::uint64_t numberOf(const std::string& text, const std::string& attribute, const std::string& name) {
  std::uint64_t value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size()) return value;
  throw SceneError(fmt::format("attribute {} is \"{}\", not a number", attribute, text), name,
                   "merge images that importon has rendered");
}

double passesOf(const Image& image, const std::string& name) {
  const std::uint64_t passes = numberOf(attributeOf(image, kPasses, name), kPasses, name);
  if (passes > 0) return static_cast<double>(passes);
  throw SceneError("the image has no passes", name, "leave it out");
}

std::vector<std::uint64_t> seedsOf(const Image& image, const std::string& name) {
  std::istringstream words(attributeOf(image, kSeeds, name));
  std::vector<std::uint64_t> seeds;
  for (std::string word; words >> word;) seeds.push_back(numberOf(word, kSeeds, name));
  return seeds;
}

/// How a layer is averaged.
enum class Kind { mean, variance, error };

bool isColor(const std::string& channel) { return channel == "R" || channel == "G" || channel == "B"; }

Kind kindOf(const std::string& channel) {
  if (channel.starts_with("variance.")) return Kind::variance;
  return channel.starts_with("error.") ? Kind::error : Kind::mean;
}

}  // namespace

void ImageMerger::start(const Image& image, const std::string& name) {
  first_ = Image{image.width, image.height, {}, image.attributes, image.whole};
  first_.matrices = image.matrices;
  firstName_ = name;
  for (const Channel& channel : image.channels) {
    first_.channels.push_back({channel.name, {}});
    sums_.emplace_back(channel.values.size(), 0.0);
    squares_.emplace_back(isColor(channel.name) ? channel.values.size() : 0, 0.0);
  }
}

void ImageMerger::check(const Image& image, const std::string& name) const {
  const std::string where = firstName_ + ", " + name;
  if (image.width != first_.width || image.height != first_.height)
    throw SceneError("the images have different sizes", where, "render them at the same size");
  if (attributeOf(image, kJob, name) != attributeOf(first_, kJob, firstName_))
    throw SceneError("the images are of different scenes or settings", where,
                     "merge runs that differ in seed and passes alone");
  bool isAlike = image.channels.size() == first_.channels.size();
  for (const Channel& channel : image.channels) isAlike = isAlike && first_.find(channel.name) != nullptr;
  if (!isAlike) throw SceneError("the images have different layers", where, "render them with the same --aov");
  for (const std::uint64_t seed : seedsOf(image, name)) {
    if (seeds_.contains(seed))
      throw SceneError(fmt::format("seed {} is there twice", seed), where, "give each run its own --seed");
  }
}

void ImageMerger::add(const Image& image, const std::string& name) {
  const double passes = passesOf(image, name);
  const std::vector<std::uint64_t> seeds = seedsOf(image, name);
  (void)attributeOf(image, kJob, name);
  if (sums_.empty()) start(image, name);
  check(image, name);
  for (std::size_t c = 0; c < sums_.size(); ++c) {
    const Channel& channel = *image.find(first_.channels[c].name);
    const Kind kind = kindOf(channel.name);
    const double weight = kind == Kind::mean ? passes : passes * passes;
    for (std::size_t i = 0; i < sums_[c].size(); ++i) {
      const auto value = static_cast<double>(channel.values[i]);
      sums_[c][i] += weight * (kind == Kind::error ? value * value : value);
      if (!squares_[c].empty()) squares_[c][i] += weight * value * value;
    }
  }
  ++images_;
  seeds_.insert(seeds.begin(), seeds.end());
  passes_ += passes;
}

/// Runs scatter around their mean with variances in proportion to one over their passes, so that of the mean of K runs
/// is sum(w (x - mean)²)/((K - 1) sum(w)). An image that lies off by its root has the error to be known.
double ImageMerger::ownError(const Image& mean) const {
  Image moved = mean;
  for (std::size_t c = 0; c < sums_.size(); ++c) {
    for (std::size_t i = 0; i < squares_[c].size(); ++i) {
      const double average = sums_[c][i] / passes_;
      const double scatter = std::max(squares_[c][i] / passes_ - average * average, 0.0);
      moved.channels[c].values[i] += static_cast<float>(std::sqrt(scatter / (images_ - 1)));
    }
  }
  return compareValues(moved, firstName_, mean, firstName_).relmseTrimmed;
}

Image ImageMerger::result() const {
  Image image = first_;
  for (std::size_t c = 0; c < sums_.size(); ++c) {
    Channel& channel = image.channels[c];
    const Kind kind = kindOf(channel.name);
    const double weight = kind == Kind::mean ? passes_ : passes_ * passes_;
    channel.values.reserve(sums_[c].size());
    for (const double sum : sums_[c]) {
      const double value = sum / weight;
      channel.values.push_back(static_cast<float>(kind == Kind::error ? std::sqrt(value) : value));
    }
  }
  image.attributes[kSeeds] = fmt::format("{}", fmt::join(seeds_, " "));
  image.attributes[kPasses] = fmt::format("{:.0f}", passes_);
  const bool hasColor = image.find("R") != nullptr && image.find("G") != nullptr && image.find("B") != nullptr;
  image.attributes.erase(kOwnError);
  if (images_ > 1 && hasColor) image.attributes[kOwnError] = fmt::format("{:.4g}", ownError(image));
  return image;
}

}  // namespace importon
