/// Animations for tests.
#pragma once
#include <string>
#include <vector>

#include "loader/gltf_builder.h"

namespace importon::test {

/// A sampler of the animation, made if it is not there; keys of T, a scalar or a vector.
template <class T>
int addSampler(GltfBuilder& builder, const std::vector<float>& times, const std::vector<T>& values,
               const std::string& type, const std::string& interpolation = "LINEAR", std::size_t animation = 0) {
  while (builder.json["animations"].size() <= animation)
    builder.add("animations", {{"channels", Json::array()}, {"samplers", Json::array()}});
  Json& samplers = builder.json["animations"][animation]["samplers"];
  const int input = builder.addAccessor(times, kFloat, "SCALAR");
  samplers.push_back(
      {{"input", input}, {"output", builder.addAccessor(values, kFloat, type)}, {"interpolation", interpolation}});
  return static_cast<int>(samplers.size()) - 1;
}

inline void addChannel(GltfBuilder& builder, int sampler, int node, const std::string& path,
                       std::size_t animation = 0) {
  builder.json["animations"][animation]["channels"].push_back(
      {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

/// KHR_animation_pointer.
inline void addPointer(GltfBuilder& builder, int sampler, const std::string& pointer, std::size_t animation = 0) {
  builder.json["animations"][animation]["channels"].push_back(
      {{"sampler", sampler},
       {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
}

/// The node goes from `from` to `to` in the first second.
inline void addMove(GltfBuilder& builder, int node, const glm::vec3& from, const glm::vec3& to,
                    std::size_t animation = 0) {
  const int sampler = addSampler<glm::vec3>(builder, {0, 1}, {from, to}, "VEC3", "LINEAR", animation);
  addChannel(builder, sampler, node, "translation", animation);
}

}  // namespace importon::test
