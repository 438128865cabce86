/// IES LM-63 files: how much light a lamp sends where.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace importon {

/// Which angles a profile is measured by. [ANSI/IESNA LM-63-02]
enum class Photometry {
  typeC = 1,  // vertical planes around the lamp's axis; vertical angles from the axis
  typeB = 2   // planes around a horizontal axis; vertical angles towards it
};

/// Candela over a grid of angles, degrees, each row in ascending order.
class IesProfile {
 public:
  IesProfile(Photometry photometry, std::vector<double> vertical, std::vector<double> horizontal,
             std::vector<double> candela)
      : photometry_(photometry),
        vertical_(std::move(vertical)),
        horizontal_(std::move(horizontal)),
        candela_(std::move(candela)) {}

  /// Candela along a unit vector of the lamp's space: it is aimed along -z, and the plane of horizontal angle 0 holds x
  /// [EXT_lights_ies]. Linear in both angles between what is measured, mirrored where the file says so by the angles
  /// that it has, and 0 beyond.
  [[nodiscard]] double intensity(const glm::dvec3& direction) const;

  /// The same all around the axis.
  [[nodiscard]] bool isAxial() const { return photometry_ == Photometry::typeC && horizontal_.size() == 1; }

 private:
  [[nodiscard]] double horizontalOf(double angle) const;

  Photometry photometry_;
  std::vector<double> vertical_, horizontal_;
  std::vector<double> candela_;  // of all vertical angles at the first horizontal one, and so on
};

/// Reads LM-63-1986 to LM-63-2019, with the candela multiplier and the ballast factor; TILT is passed over. Throws
/// SceneError at `where` for what is no such file, is cut off, or is of photometry of type A.
[[nodiscard]] IesProfile parseIes(std::span<const unsigned char> bytes, const std::string& where);

}  // namespace importon
