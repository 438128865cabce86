/// The two photon maps of the method.
#pragma once
#include <array>

#include "shared/render_data.h"

namespace importon {

enum class MapKind { caustic, global };

/// In the order in which a pass fills them.
inline constexpr std::array kMapKinds{MapKind::global, MapKind::caustic};

/// All in which the two differ, beside their numbers in PassPlan and Parameters.
struct MapTraits {
  const char* name;
  uint recordMask;  // of the records that belong to the map
  MapSettings Parameters::*settings;
  uint randomStream;     // of photons by power
  int guideBins;         // along both axes of a light's unit square
  float leastGain;       // of a guide of its emission, from which on the guide is used if that is left open
  bool guidesScatter;    // its photons meet surfaces where they scatter anew
  bool countsFirstHits;  // its map is seen directly, from the first pass on
  bool isGathered;       // gather rays read it, which irradiance may be precomputed for
};

[[nodiscard]] constexpr MapTraits traitsOf(MapKind kind) {
  return kind == MapKind::global
             ? MapTraits{"global", kRecordGlobal, &Parameters::globalMap, kStreamGlobalPhotons, 16, 1.5f, true,
                         false,    true}
             : MapTraits{"caustic", kRecordCaustic, &Parameters::causticMap, kStreamCausticPhotons, 128, 0.0f, false,
                         true,      false};
}

[[nodiscard]] constexpr uint recordMask(MapKind kind) { return traitsOf(kind).recordMask; }

}  // namespace importon
