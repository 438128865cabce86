#include "render/device_scene/media.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scene/materials/material_table.h"

namespace importon {
namespace {

/// How different two media are, in index and in what they absorb over a unit of length.
float distanceOf(const Material& a, const Material& b) {
  return std::abs(a.ior - b.ior) + 0.025f * std::abs(a.ior * a.dispersion - b.ior * b.dispersion) +
         glm::length(glm::exp(-a.absorption) - glm::exp(-b.absorption));
}

}  // namespace

std::vector<Material> withMedia(std::vector<Material> materials) {
  std::vector<uint> known;  // a material of each medium
  for (std::size_t i = 0; i < materials.size(); ++i) {
    Material& material = materials[i];
    material.medium = 0;
    if (material_table::isPane(material)) material.flags |= kMaterialPane;
    if ((material.flags & kMaterialSolid) == 0) continue;
    const auto isAlike = [&](uint k) {
      return materials[k].ior == material.ior && materials[k].absorption == material.absorption &&
             materials[k].dispersion == material.dispersion;
    };
    auto medium = std::ranges::find_if(known, isAlike);
    if (medium == known.end() && known.size() < kMostMedia) {
      known.push_back(static_cast<uint>(i));
      medium = known.end() - 1;
    } else if (medium == known.end()) {
      medium = std::ranges::min_element(known, {}, [&](uint k) { return distanceOf(materials[k], material); });
    }
    material.medium = static_cast<uint>(medium - known.begin()) + 1;
  }
  for (std::size_t m = 0; m < known.size(); ++m) materials[m].materialOfMedium = known[m];
  return materials;
}

void warnOfMedia(const std::vector<Material>& materials, Log& log) {
  std::set<std::array<float, 5>> media;
  for (const Material& m : materials)
    if ((m.flags & kMaterialSolid) != 0)
      media.insert({m.ior, m.dispersion, m.absorption.x, m.absorption.y, m.absorption.z});
  if (media.size() <= kMostMedia) return;
  log.warn("many media",
           fmt::format("solids are of {} media, by index, dispersion and absorption; those beyond {} take "
                       "the nearest of these",
                       media.size(), kMostMedia));
}

}  // namespace importon
