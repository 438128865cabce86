#include "render/film/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "base/trimmed_mean.h"

namespace importon {
namespace {

constexpr int kBlock = 4;        // side of the blocks for the bias, pixels
constexpr int kErrorWindow = 3;  // half the side of the window of the error per pixel

double meanOf(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3; }

/// What relMSE divides by.
class Denominators {
 public:
  explicit Denominators(const HalfImages& shown) : shown_(shown) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < shown.even.size(); ++i) sum += image(i);
    const double mean = meanOf(sum) / static_cast<double>(shown.even.size());
    floor_ = std::max(0.01 * mean * mean, 1e-300);
  }
  [[nodiscard]] glm::dvec3 at(std::size_t pixel) const { return image(pixel) * image(pixel) + floor_; }

 private:
  [[nodiscard]] glm::dvec3 image(std::size_t i) const {
    return glm::mix(glm::dvec3(shown_.odd[i]), glm::dvec3(shown_.even[i]), static_cast<double>(shown_.evenShare));
  }
  const HalfImages& shown_;
  double floor_ = 0;
};

/// Means over blocks of what sharing moved in both halves, and of the denominators.
struct Block {
  glm::dvec3 even{0}, odd{0}, denominator{0};
  double pixels = 0;
};

std::vector<Block> blocksOf(const HalfImages& shown, const HalfImages& raw, const Denominators& denominators,
                            std::size_t width) {
  const std::size_t height = shown.even.size() / width, across = (width + kBlock - 1) / kBlock;
  std::vector<Block> blocks(across * ((height + kBlock - 1) / kBlock));
  for (std::size_t i = 0; i < shown.even.size(); ++i) {
    Block& block = blocks[i / width / kBlock * across + i % width / kBlock];
    block.even += glm::dvec3(shown.even[i] - raw.even[i]);
    block.odd += glm::dvec3(shown.odd[i] - raw.odd[i]);
    block.denominator += denominators.at(i);
    ++block.pixels;
  }
  for (Block& block : blocks) {
    block.even /= block.pixels;
    block.odd /= block.pixels;
    block.denominator /= block.pixels;
  }
  return blocks;
}

/// Means of `values` over windows, rows first.
std::vector<glm::dvec3> blur(const std::vector<glm::dvec3>& values, int width) {
  const int height = static_cast<int>(values.size()) / width;
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const auto pass = [&](const std::vector<glm::dvec3>& from, int dx, int dy) {
    std::vector<glm::dvec3> to(from.size());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        glm::dvec3 sum(0);
        double count = 0;
        for (int k = -kErrorWindow; k <= kErrorWindow; ++k) {
          const int qx = x + k * dx, qy = y + k * dy;
          if (qx < 0 || qy < 0 || qx >= width || qy >= height) continue;
          sum += from[at(qx, qy)];
          ++count;
        }
        to[at(x, y)] = sum / count;
      }
    }
    return to;
  };
  return pass(pass(values, 1, 0), 0, 1);
}

}  // namespace

ErrorEstimate estimateErrors(const HalfImages& shown, const HalfImages& raw, int width) {
  const Denominators denominators(shown);
  const std::size_t pixels = shown.even.size();
  const double share = static_cast<double>(shown.evenShare), scale = share * (1 - share);  // of a mean's variance
  std::vector<double> relative(pixels);
  std::vector<glm::dvec3> squares(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const glm::dvec3 difference = glm::dvec3(shown.even[i]) - glm::dvec3(shown.odd[i]);
    squares[i] = scale * difference * difference;
    relative[i] = meanOf(squares[i] / denominators.at(i));
  }
  const double noise = trimmedMean(std::move(relative));

  std::vector<double> moved;
  double movedMean = 0;
  for (const Block& block : blocksOf(shown, raw, denominators, static_cast<std::size_t>(width)))
    moved.push_back(meanOf(block.even * block.odd / block.denominator));
  if (!moved.empty()) movedMean = std::max(trimmedMean(std::move(moved)), 0.0);

  ErrorEstimate estimate{std::sqrt(noise), std::sqrt(movedMean), std::sqrt(noise + movedMean), {}};
  const std::vector<glm::dvec3> smooth = blur(squares, width);
  for (std::size_t i = 0; i < pixels; ++i)
    estimate.perPixel.emplace_back(glm::sqrt(smooth[i] + movedMean * denominators.at(i)));
  return estimate;
}

}  // namespace importon
