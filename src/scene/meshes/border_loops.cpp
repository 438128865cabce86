#include "scene/meshes/border_loops.h"

#include <algorithm>

namespace importon {
namespace {

constexpr std::size_t kNoBorder = static_cast<std::size_t>(-1);

class LoopFinder {
 public:
  explicit LoopFinder(const std::vector<Border>& borders) : borders_(borders), isUsed_(borders.size(), false) {}

  std::vector<BorderLoop> find() {
    std::vector<BorderLoop> loops;
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      if (isUsed_[i]) continue;
      BorderLoop loop{{i}, 0};
      isUsed_[i] = true;
      while (loop.borders.back() != kNoBorder && borders_[loop.borders.back()].to != borders_[i].from)
        loop.borders.push_back(takeNext(loop.borders.back()));
      if (loop.borders.back() == kNoBorder) continue;  // a way without an end
      loop.area = areaOf(loop);
      loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  static glm::dvec3 directionOf(const Border& border) { return glm::normalize(border.end - border.start); }

  std::size_t takeNext(std::size_t border) {
    const uint place = borders_[border].to;
    const auto first = std::ranges::lower_bound(borders_, place, {}, &Border::from);
    std::size_t best = kNoBorder;
    double least = 2;
    for (auto next = first; next != borders_.end() && next->from == place; ++next) {
      const auto index = static_cast<std::size_t>(next - borders_.begin());
      const double turn = glm::dot(directionOf(borders_[border]), directionOf(*next));
      if (isUsed_[index] || !(turn < least)) continue;
      best = index;
      least = turn;
    }
    if (best != kNoBorder) isUsed_[best] = true;
    return best;
  }

  [[nodiscard]] double areaOf(const BorderLoop& loop) const {
    const glm::dvec3 origin = borders_[loop.borders.front()].start;
    glm::dvec3 sum(0.0);
    for (const std::size_t i : loop.borders) sum += glm::cross(borders_[i].start - origin, borders_[i].end - origin);
    return 0.5 * glm::length(sum);
  }

  const std::vector<Border>& borders_;
  std::vector<bool> isUsed_;
};

}  // namespace

std::vector<BorderLoop> findLoops(const std::vector<Border>& borders) { return LoopFinder(borders).find(); }

}  // namespace importon
