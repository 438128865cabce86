/// Translation, rotation and scale as a matrix.
#pragma once
#include <glm/glm.hpp>
#include <string>

#include "scene/container/faults.h"

namespace importon {

struct Transform {
  glm::dvec3 translation{0.0};
  glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  // quaternion x, y, z, w; of any length but 0
  glm::dvec3 scale{1.0};
};

/// T R S (glTF 2.0, section 3.5.3). A rotation that has no direction is a small fault at `pointer`, and the identity.
[[nodiscard]] glm::dmat4 matrixOf(const Transform& transform, const Faults& faults, const std::string& pointer);

}  // namespace importon
