#include "scene/meshes/weld.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace importon {
namespace {

constexpr double kWeldTolerance = 1e-6;  // of the diagonal

bool isFinite(const vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Places in cells four tolerances wide: a vertex is near those of its own cell and, close to a side, of the next one.
class Places {
 public:
  explicit Places(const std::vector<MeshPart>& parts) {
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    low_ = -high;
    for (const MeshPart& part : parts) {
      for (const vec3& p : part.positions) {
        if (!isFinite(p)) continue;
        low_ = glm::min(low_, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
      }
    }
    tolerance_ = kWeldTolerance * glm::length(high - low_);
  }

  uint of(const vec3& position) {
    if (!isFinite(position)) return count_++;
    const glm::dvec3 p = glm::dvec3(position) - low_;
    if (!(tolerance_ > 0)) return addOnly();
    const glm::dvec3 least = cell(p - tolerance_), most = cell(p + tolerance_);
    for (double x = least.x; x <= most.x; ++x) {
      for (double y = least.y; y <= most.y; ++y) {
        for (double z = least.z; z <= most.z; ++z) {
          const uint found = nearestIn(key({x, y, z}), p);
          if (found != kNone) return found;
        }
      }
    }
    return add(p);
  }

 private:
  struct Place {
    glm::dvec3 position;
    uint number;
    uint next;  // of the same cell
  };

  /// Of points that are all one.
  uint addOnly() {
    if (only_ == kNone) only_ = count_++;
    return only_;
  }
  [[nodiscard]] glm::dvec3 cell(const glm::dvec3& p) const { return glm::floor(p / (4.0 * tolerance_)); }
  /// Cells are few enough for 20 bits an axis.
  static std::uint64_t key(const glm::dvec3& cell) {
    std::uint64_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) bits = bits << 20 | static_cast<std::uint64_t>(cell[axis] + 1);
    return bits;
  }
  [[nodiscard]] uint nearestIn(std::uint64_t key, const glm::dvec3& p) const {
    const auto first = firstOfCell_.find(key);
    if (first == firstOfCell_.end()) return kNone;
    for (uint i = first->second; i != kNone; i = places_[i].next)
      if (glm::distance(places_[i].position, p) <= tolerance_) return places_[i].number;
    return kNone;
  }
  uint add(const glm::dvec3& p) {
    const auto index = static_cast<uint>(places_.size());
    const auto [entry, isNew] = firstOfCell_.try_emplace(key(cell(p)), index);
    places_.push_back({p, count_, isNew ? kNone : entry->second});
    entry->second = index;
    return count_++;
  }

  glm::dvec3 low_{0.0};
  double tolerance_ = 0;
  uint count_ = 0, only_ = kNone;
  std::vector<Place> places_;
  std::unordered_map<std::uint64_t, uint> firstOfCell_;
};

}  // namespace

std::vector<std::vector<uint>> weldVertices(const std::vector<MeshPart>& parts) {
  Places places(parts);
  std::vector<std::vector<uint>> numbers;
  for (const MeshPart& part : parts) {
    std::vector<uint>& own = numbers.emplace_back();
    own.reserve(part.positions.size());
    for (const vec3& position : part.positions) own.push_back(places.of(position));
  }
  return numbers;
}

}  // namespace importon
