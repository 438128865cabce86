#include "scene/nodes/transform.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace importon {

glm::dmat4 matrixOf(const Transform& transform, const Faults& faults, const std::string& pointer) {
  const glm::dvec4& q = transform.rotation;
  const glm::dquat rotation(q.w, q.x, q.y, q.z);
  const double length = glm::length(rotation);
  glm::dmat4 result(1.0);
  if (length > 0 && std::isfinite(length)) {
    result = glm::mat4_cast(rotation / length);
  } else {
    faults.forgive("rotation of length 0", pointer, "the rotation is not a unit quaternion", "nothing is rotated");
  }
  for (int axis = 0; axis < 3; ++axis) result[axis] *= transform.scale[axis];
  result[3] = glm::dvec4(transform.translation, 1.0);
  return result;
}

}  // namespace importon
