#include "scene/meshes/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>

#include "base/error.h"
#include "scene/container/gltf_view.h"

namespace importon {
namespace {

/// Without data an accessor is all zeros, and its count is bounded by nothing in the file.
constexpr std::size_t kMostZeroElements = std::size_t{1} << 24;

/// What is being read, and for whom.
struct Context {
  const GltfDocument& document;
  const std::string& pointer;

  [[noreturn]] void fail(const std::string& what) const {
    throw SceneError(what, document.source.at(pointer), "correct the file or export it again");
  }
};

/// `count` elements of `bytes` each, `stride` apart; none if `data` is empty.
struct Elements {
  std::span<const unsigned char> data;
  std::size_t count = 0;
  std::size_t bytes = 0;
  std::size_t stride = 0;
};

/// The elements from `byteOffset` of a buffer view on, all of them inside of it.
Elements locate(const Context& context, int bufferView, std::size_t byteOffset, std::size_t count, std::size_t bytes) {
  const auto viewIndex = static_cast<std::size_t>(bufferView);
  const tinygltf::BufferView& view = context.document.model.bufferViews[viewIndex];
  const std::size_t stride = view.byteStride == 0 ? bytes : view.byteStride;
  if (stride < bytes) {
    context.fail(fmt::format("a stride of {} bytes is less than an element of {}", stride, bytes));
  }
  const bool isInside = byteOffset <= view.byteLength && bytes <= view.byteLength - byteOffset &&
                        count - 1 <= (view.byteLength - byteOffset - bytes) / stride;
  if (!isInside) {
    context.fail(fmt::format("{} elements of {} bytes from byte {} on reach past the buffer view of {} bytes", count,
                             bytes, byteOffset, view.byteLength));
  }
  return {viewBytes(context.document, viewIndex).subspan(byteOffset, (count - 1) * stride + bytes), count, bytes,
          stride};
}

std::size_t componentBytes(const Context& context, int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      context.fail(fmt::format("component type {} is not one of glTF", componentType));
  }
}

template <typename T>
T load(const unsigned char* data) {
  T value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

/// 0 for matrices.
int vectorLength(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      return 0;
  }
}

/// glTF 2.0, section 3.6.2.2: c / max, and for signed types not below -1.
template <typename T>
float toFloat(T value, bool isNormalized) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    const auto number = static_cast<float>(value);
    if (!isNormalized) return number;
    return std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  }
}

template <typename T, int N>
void convert(const Elements& elements, bool isNormalized, int components, glm::vec<N, float>* out) {
  const unsigned char* element = elements.data.data();
  for (std::size_t i = 0; i < elements.count; ++i, element += elements.stride) {
    for (int c = 0; c < components; ++c) {
      out[i][c] = toFloat(load<T>(element + static_cast<std::size_t>(c) * sizeof(T)), isNormalized);
    }
  }
}

template <int N>
void convertAny(const Elements& elements, const tinygltf::Accessor& accessor, int components, glm::vec<N, float>* out) {
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return convert<std::int8_t, N>(elements, accessor.normalized, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return convert<std::uint8_t, N>(elements, accessor.normalized, components, out);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return convert<std::int16_t, N>(elements, accessor.normalized, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return convert<std::uint16_t, N>(elements, accessor.normalized, components, out);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return convert<std::uint32_t, N>(elements, accessor.normalized, components, out);
    default:
      return convert<float, N>(elements, accessor.normalized, components, out);
  }
}

std::vector<std::uint32_t> unsignedIntegers(const Context& context, const Elements& elements, int componentType) {
  std::vector<std::uint32_t> values(elements.count);
  const unsigned char* element = elements.data.data();
  for (std::uint32_t& value : values) {
    switch (componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        value = *element;
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        value = load<std::uint16_t>(element);
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        value = load<std::uint32_t>(element);
        break;
      default:
        context.fail("indices must be unsigned integers");
    }
    element += elements.stride;
  }
  return values;
}

/// How many zeros stand for an accessor without data.
std::size_t zeroElements(const Context& context, const tinygltf::Accessor& accessor) {
  if (accessor.count <= kMostZeroElements) return accessor.count;
  context.fail(fmt::format("{} elements without a buffer view are more than {}", accessor.count, kMostZeroElements));
}

/// The places that a sparse accessor replaces.
std::vector<std::uint32_t> sparseIndices(const Context& context, const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  const std::size_t bytes = componentBytes(context, sparse.indices.componentType);
  const Elements elements =
      locate(context, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
             static_cast<std::size_t>(sparse.count), bytes);
  std::vector<std::uint32_t> places = unsignedIntegers(context, elements, sparse.indices.componentType);
  for (const std::uint32_t place : places) {
    if (place >= accessor.count) {
      context.fail(fmt::format("sparse index {} is not among the {} elements", place, accessor.count));
    }
  }
  return places;
}

template <int N>
void applySparse(const Context& context, const tinygltf::Accessor& accessor, int components, std::size_t bytes,
                 std::vector<glm::vec<N, float>>& values) {
  const std::vector<std::uint32_t> places = sparseIndices(context, accessor);
  const Elements elements = locate(context, accessor.sparse.values.bufferView,
                                   static_cast<std::size_t>(accessor.sparse.values.byteOffset), places.size(), bytes);
  std::vector<glm::vec<N, float>> replacements(places.size(), glm::vec<N, float>(1.0f));
  convertAny<N>(elements, accessor, components, replacements.data());
  for (std::size_t i = 0; i < places.size(); ++i) values[places[i]] = replacements[i];
}

}  // namespace

template <int N>
std::vector<glm::vec<N, float>> readFloats(const GltfDocument& document, int accessorIndex,
                                           const std::string& pointer) {
  const Context context{document, pointer};
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(accessorIndex)];
  const int components = vectorLength(accessor.type);
  if (components != N && !(N == 4 && components == 3)) {
    context.fail(fmt::format("accessor {} does not hold vectors of {} numbers", accessorIndex, N));
  }
  const std::size_t bytes = componentBytes(context, accessor.componentType) * static_cast<std::size_t>(components);
  std::vector<glm::vec<N, float>> values;
  if (accessor.count == 0) return values;
  if (accessor.bufferView >= 0) {
    const Elements elements = locate(context, accessor.bufferView, accessor.byteOffset, accessor.count, bytes);
    values.resize(elements.count, glm::vec<N, float>(1.0f));
    convertAny<N>(elements, accessor, components, values.data());
  } else {
    values.resize(zeroElements(context, accessor), glm::vec<N, float>(0.0f));
  }
  if (accessor.sparse.isSparse) applySparse<N>(context, accessor, components, bytes, values);
  return values;
}

template std::vector<glm::vec1> readFloats<1>(const GltfDocument&, int, const std::string&);
template std::vector<glm::vec2> readFloats<2>(const GltfDocument&, int, const std::string&);
template std::vector<glm::vec3> readFloats<3>(const GltfDocument&, int, const std::string&);
template std::vector<glm::vec4> readFloats<4>(const GltfDocument&, int, const std::string&);

std::vector<std::uint32_t> readIndices(const GltfDocument& document, int accessorIndex, const std::string& pointer) {
  const Context context{document, pointer};
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(accessorIndex)];
  if (accessor.type != TINYGLTF_TYPE_SCALAR) {
    context.fail(fmt::format("accessor {} does not hold indices", accessorIndex));
  }
  if (accessor.normalized) {
    document.faults.forgive("normalized indices", pointer,
                            fmt::format("accessor {} does not hold indices", accessorIndex),
                            "its 'normalized' is passed over");
  }
  const std::size_t bytes = componentBytes(context, accessor.componentType);
  std::vector<std::uint32_t> values;
  if (accessor.bufferView >= 0) {
    const Elements elements = locate(context, accessor.bufferView, accessor.byteOffset, accessor.count, bytes);
    values = unsignedIntegers(context, elements, accessor.componentType);
  } else {
    values.resize(zeroElements(context, accessor));
  }
  if (accessor.sparse.isSparse) {
    const std::vector<std::uint32_t> places = sparseIndices(context, accessor);
    const Elements replacements =
        locate(context, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
               places.size(), bytes);
    const std::vector<std::uint32_t> replaced = unsignedIntegers(context, replacements, accessor.componentType);
    for (std::size_t i = 0; i < places.size(); ++i) values[places[i]] = replaced[i];
  }
  return values;
}

std::vector<glm::mat4> readMatrices(const GltfDocument& document, int accessorIndex, const std::string& pointer) {
  const Context context{document, pointer};
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(accessorIndex)];
  const bool isPlain = accessor.type == TINYGLTF_TYPE_MAT4 && accessor.bufferView >= 0 &&
                       accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor.sparse.isSparse;
  if (!isPlain) context.fail(fmt::format("accessor {} does not hold matrices of floats", accessorIndex));
  const Elements elements =
      locate(context, accessor.bufferView, accessor.byteOffset, accessor.count, sizeof(glm::mat4));
  std::vector<glm::mat4> matrices(elements.count);
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    matrices[i] = load<glm::mat4>(elements.data.data() + i * elements.stride);
  }
  return matrices;
}

}  // namespace importon
