/// The holes of a surface.
#pragma once
#include <cstddef>
#include <vector>

#include "shared/scene_data.h"

namespace importon {

/// A side of a face that no other face has, in the direction in which it runs around the face.
struct Border {
  uint from = 0, to = 0;  // places, as of weldVertices
  glm::dvec3 start{0.0}, end{0.0};
  std::size_t edge = 0, face = 0;
};

/// A hole: its sides, one after the other, and the area of the flattest surface over it.
struct BorderLoop {
  std::vector<std::size_t> borders;  // indices
  double area = 0;
};

/// The closed loops that `borders` make, which are sorted by `from`. Where several go on from one place, the one that
/// turns back the most does: where the long side of a face lies along short ones of others, they make a loop without
/// area.
[[nodiscard]] std::vector<BorderLoop> findLoops(const std::vector<Border>& borders);

}  // namespace importon
