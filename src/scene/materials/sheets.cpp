#include "scene/materials/sheets.h"

#include <cmath>
#include <map>
#include <utility>

namespace importon {
namespace {

/// Lengths in the world over those in the mesh, in the mean over all directions.
float scaleOf(const glm::dmat4& worldFromObject) {
  return static_cast<float>(std::cbrt(std::abs(glm::determinant(glm::dmat3(worldFromObject)))));
}

class SheetTable {
 public:
  SheetTable(MaterialSet& set, std::vector<bool> isUsedClosed) : set_(set), isTaken_(std::move(isUsedClosed)) {}

  uint sheetOf(uint material, float scale) {
    const auto [entry, isNew] = made_.try_emplace({material, scale}, material);
    if (isNew) entry->second = make(material, scale);
    return entry->second;
  }

 private:
  /// In the place of the material itself, where nothing else has it.
  uint make(uint material, float scale) {
    const auto [base, isFirst] = bases_.try_emplace(material, set_.materials[material]);
    const bool isInPlace = isFirst && !isTaken_[material];
    const uint index = isInPlace ? material : append(material);
    Material& sheet = set_.materials[index];
    sheet = base->second;
    sheet.flags &= ~kMaterialSolid;
    sheet.thickness *= scale;
    return index;
  }

  uint append(uint material) {
    const auto index = static_cast<uint>(set_.materials.size());
    set_.materials.emplace_back();
    set_.names.push_back(set_.names[material]);
    for (std::size_t i = 0, count = set_.glossiness.size(); i < count; ++i)
      if (set_.glossiness[i].material == material) set_.glossiness.push_back({index, set_.glossiness[i].factor});
    return index;
  }

  MaterialSet& set_;
  std::vector<bool> isTaken_;       // by solids
  std::map<uint, Material> bases_;  // as the file has them
  std::map<std::pair<uint, float>, uint> made_;
};

}  // namespace

void useSheets(std::span<MeshInstance> instances, MaterialSet& set) {
  std::vector<bool> isUsedClosed(set.materials.size(), false);
  for (const MeshInstance& instance : instances)
    if (!instance.part->isOpen) isUsedClosed[instance.material] = true;
  SheetTable table(set, std::move(isUsedClosed));
  for (MeshInstance& instance : instances)
    if (instance.part->isOpen) instance.material = table.sheetOf(instance.material, scaleOf(instance.worldFromObject));
}

}  // namespace importon
