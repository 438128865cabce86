/// Sums over the passes that are done: the next one goes on where they ended.
#pragma once
#include <cstdint>

#include "render/map_kind.h"

namespace importon {

struct PassSums {
  struct Photons {
    std::uint64_t shot = 0;
    std::uint64_t counted = 0;  // whose hits are counted near importons, the pilot's too
  };
  std::uint64_t evenSamples = 0, oddSamples = 0;  // per pixel
  Photons caustic, global;

  [[nodiscard]] const Photons& of(MapKind kind) const { return kind == MapKind::global ? global : caustic; }
  [[nodiscard]] Photons& of(MapKind kind) { return kind == MapKind::global ? global : caustic; }
};

}  // namespace importon
