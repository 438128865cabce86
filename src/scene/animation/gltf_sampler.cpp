#include "scene/animation/gltf_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/meshes/gltf_accessor.h"

namespace importon {
namespace {

const tinygltf::Accessor& accessorOf(const GltfDocument& document, int index) {
  return document.model.accessors[static_cast<std::size_t>(index)];
}

[[noreturn]] void fail(const GltfDocument& document, const std::string& what, const std::string& pointer) {
  throw SceneError(what, document.source.at(pointer), kExportAgain);
}

/// Zeros rise nowhere: keys without data are refused before there is memory for them.
void checkTimes(const GltfDocument& document, const tinygltf::Accessor& accessor, const std::string& pointer) {
  const bool areFloats =
      accessor.type == TINYGLTF_TYPE_SCALAR && accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (!areFloats) fail(document, "the times of keys are not single floats", pointer);
  const auto sparse = static_cast<std::size_t>(accessor.sparse.isSparse ? std::max(accessor.sparse.count, 0) : 0);
  if (accessor.bufferView < 0 && accessor.count > sparse + 1)
    fail(document, fmt::format("{} keys have no times", accessor.count), pointer);
}

template <int N>
std::vector<float> flat(const GltfDocument& document, int accessor, const std::string& pointer) {
  const std::vector<glm::vec<N, float>> vectors = readFloats<N>(document, accessor, pointer);
  std::vector<float> numbers;
  numbers.reserve(vectors.size() * N);
  for (const glm::vec<N, float>& vector : vectors)
    for (int c = 0; c < N; ++c) numbers.push_back(vector[c]);
  return numbers;
}

/// `width` numbers in each element, 1 to 4.
std::vector<float> readNumbers(const GltfDocument& document, int accessor, std::size_t width,
                               const std::string& pointer) {
  switch (width) {
    case 1:
      return flat<1>(document, accessor, pointer);
    case 2:
      return flat<2>(document, accessor, pointer);
    case 3:
      return flat<3>(document, accessor, pointer);
    default:
      return flat<4>(document, accessor, pointer);
  }
}

/// Rotations and weights in integers are parts of the largest, whether the accessor says so or not; quaternions of any
/// length are the same rotation.
void normalise(const GltfDocument& document, const tinygltf::Accessor& accessor, const std::string& pointer,
               std::vector<float>& numbers) {
  if (accessor.normalized || accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return;
  float most = 1;
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      most = 127;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      most = 255;
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      most = 32767;
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      most = 65535;
      break;
    default:
      fail(document, "rotations and weights are floats, or integers of 8 or 16 bits", pointer);
  }
  document.faults.forgive("keys not normalized", pointer, "rotations or weights in integers are not normalized",
                          "they are taken as if they were");
  for (float& number : numbers) number = std::max(number / most, -1.0f);
}

Interpolation interpolationOf(const nlohmann::json& sampler, const AnimatedValue& value) {
  const std::string name = stringOr(sampler, "interpolation", "LINEAR");
  if (name == "STEP" || value.kind == AnimatedValue::Kind::boolean) return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubicSpline : Interpolation::linear;
}

/// The elements that the keys need, and their kind, before any is read.
void checkOutput(const GltfDocument& document, const tinygltf::Accessor& accessor, const KeyTrack& track,
                 std::size_t elementWidth, const std::string& pointer) {
  constexpr std::array kTypes{TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
  if (elementWidth > kTypes.size() || accessor.type != kTypes[elementWidth - 1])
    fail(document, fmt::format("the values of keys are not {} numbers each", elementWidth), pointer);
  const std::size_t elements = track.width / elementWidth * (track.interpolation == Interpolation::cubicSpline ? 3 : 1);
  if (accessor.count == track.times.size() * elements) return;
  fail(document,
       fmt::format("{} keys have {} values but need {}", track.times.size(), accessor.count,
                   track.times.size() * elements),
       pointer);
}

}  // namespace

std::vector<float> readKeyTimes(const GltfDocument& document, const nlohmann::json& sampler,
                                const std::string& pointer) {
  const int input = integerOr(sampler, "input", 0);
  const std::string place = pointer + "/input";
  checkTimes(document, accessorOf(document, input), place);
  std::vector<float> times = flat<1>(document, input, place);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || times[i] < 0)
      fail(document, fmt::format("the time of key {} is {}, which is none", i, times[i]), place);
    if (i == 0 || times[i] > times[i - 1]) continue;
    const std::string what = fmt::format("key {} is at {} s, after one at {} s", i, times[i], times[i - 1]);
    if (times[i] < times[i - 1]) fail(document, what, place);
    document.faults.forgive("keys at one time", place, what, "the last of them is meant");
  }
  return times;
}

KeyTrack readKeyTrack(const GltfDocument& document, const nlohmann::json& sampler, const std::string& pointer,
                      const AnimatedValue& value) {
  KeyTrack track{
      interpolationOf(sampler, value), value.width, value.isRotation, readKeyTimes(document, sampler, pointer), {}};
  if (track.times.empty()) return track;
  const std::string place = pointer + "/output";
  const int output = integerOr(sampler, "output", 0);
  const tinygltf::Accessor& accessor = accessorOf(document, output);
  const std::size_t elementWidth = value.isWeights ? 1 : value.width;
  checkOutput(document, accessor, track, elementWidth, place);
  track.values = readNumbers(document, output, elementWidth, place);
  if (value.isRotation || value.isWeights) normalise(document, accessor, place, track.values);
  const auto wrong = std::ranges::find_if(track.values, [](float number) { return !std::isfinite(number); });
  if (wrong == track.values.end()) return track;
  fail(document, fmt::format("number {} of the keys is not finite", wrong - track.values.begin()), place);
}

}  // namespace importon
