/// The table of the extra layers that `--aov` offers: docs/adding.md.
#pragma once
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "shared/render_data.h"

namespace importon {

/// Where a layer comes from: a kernel writes it into the AOV buffer at the middle of each pixel; it is one of the
/// film's; or it counts points of a map in each pixel.
enum class AovSource { buffer, filmDirect, filmCaustic, filmIndirect, filmVariance, filmError, importons, photons };

struct AovRow {
  std::string_view name;
  std::string_view suffixes;  // of its channels, one character each
  AovSource source = AovSource::buffer;
  uint offset = 0;  // in the AOV buffer
};

inline constexpr std::array kAovTable{AovRow{"albedo", "RGB", AovSource::buffer, kAovAlbedo},
                                      AovRow{"N", "XYZ", AovSource::buffer, kAovNormal},
                                      AovRow{"P", "XYZ", AovSource::buffer, kAovPosition},
                                      AovRow{"depth", "Z", AovSource::buffer, kAovDepth},
                                      AovRow{"direct", "RGB", AovSource::filmDirect},
                                      AovRow{"caustic", "RGB", AovSource::filmCaustic},
                                      AovRow{"indirect", "RGB", AovSource::filmIndirect},
                                      AovRow{"emission", "RGB", AovSource::buffer, kAovEmission},
                                      AovRow{"variance", "RGB", AovSource::filmVariance},
                                      AovRow{"error", "RGB", AovSource::filmError},
                                      AovRow{"importance.caustic", "Y", AovSource::buffer, kAovImportance},
                                      AovRow{"importance.global", "Y", AovSource::buffer, kAovImportance + 1},
                                      AovRow{"required.caustic", "Y", AovSource::buffer, kAovRequired},
                                      AovRow{"required.global", "Y", AovSource::buffer, kAovRequired + 1},
                                      AovRow{"density.caustic", "Y", AovSource::buffer, kAovDensity},
                                      AovRow{"density.global", "Y", AovSource::buffer, kAovDensity + 1},
                                      AovRow{"radiance.caustic", "RGB", AovSource::buffer, kAovMapLight},
                                      AovRow{"radiance.global", "RGB", AovSource::buffer, kAovMapLight + 3},
                                      AovRow{"importons.caustic", "Y", AovSource::importons},
                                      AovRow{"importons.global", "Y", AovSource::importons},
                                      AovRow{"photons.caustic", "Y", AovSource::photons},
                                      AovRow{"photons.global", "Y", AovSource::photons}};

/// Of that name, which is one of the table's.
[[nodiscard]] constexpr const AovRow& aovRow(std::string_view name) {
  for (const AovRow& row : kAovTable)
    if (row.name == name) return row;
  throw std::logic_error("no such layer");
}

[[nodiscard]] inline std::vector<std::string> aovNames() {
  std::vector<std::string> names;
  for (const AovRow& row : kAovTable) names.emplace_back(row.name);
  return names;
}

}  // namespace importon
