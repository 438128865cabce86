#include "scene/instances/placed_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

namespace importon {

void AreaTensor::add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 vector = 0.5 * glm::cross(b - a, c - a);
  const double area = glm::length(vector);
  if (!(area > 0)) return;
  const glm::dvec3 scaled = vector / area;
  const std::array<double, 6> products{scaled.x * vector.x, scaled.y * vector.y, scaled.z * vector.z,
                                       scaled.x * vector.y, scaled.x * vector.z, scaled.y * vector.z};
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += static_cast<float>(products[i]);
}

void AreaTensor::add(const AreaTensor& other) {
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
}

double AreaTensor::quadratic(const glm::dvec3& v) const {
  const std::array<double, 6> weights{v.x * v.x, v.y * v.y, v.z * v.z, 2 * v.x * v.y, 2 * v.x * v.z, 2 * v.y * v.z};
  double sum = 0;
  for (std::size_t i = 0; i < sums_.size(); ++i) sum += weights[i] * static_cast<double>(sums_[i]);
  return sum;
}

double AreaTensor::areaSeenAlong(int axis, const glm::dmat3& cofactors) const {
  return std::sqrt(std::max(area() * quadratic(glm::dvec3(glm::row(cofactors, axis))), 0.0));
}

double AreaTensor::areaAfter(const glm::dmat3& cofactors) const {
  double trace = 0;
  for (int axis = 0; axis < 3; ++axis) trace += quadratic(glm::dvec3(glm::row(cofactors, axis)));
  return std::sqrt(std::max(area() * trace, 0.0));
}

glm::dmat3 Placement::cofactors() const {
  return {glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1])};
}

void Placement::includeBox(const vec3& boxLow, const vec3& boxHigh, glm::dvec3& low, glm::dvec3& high) const {
  const glm::dvec3 half = (glm::dvec3(boxHigh) - glm::dvec3(boxLow)) * 0.5;
  const glm::dvec3 centre = linear * (glm::dvec3(boxLow) + half) + translation;
  const glm::dvec3 reach = glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y + glm::abs(linear[2]) * half.z;
  low = glm::min(low, centre - reach);
  high = glm::max(high, centre + reach);
}

Placement PlacedInstance::placement() const {
  Placement result;
  for (int row = 0; row < 3; ++row) {
    const vec4& from = renderFromObject[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column) result.linear[column][row] = static_cast<double>(from[column]);
    result.translation[row] = static_cast<double>(from.w);
  }
  return result;
}

std::size_t PlacedMeshes::pageCount() const {
  if (instances.empty()) return 0;
  return instances.back().firstPage + meshes[instances.back().mesh].pages.size();
}

}  // namespace importon
