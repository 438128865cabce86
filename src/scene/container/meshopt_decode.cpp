#include "scene/container/meshopt_decode.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "base/error.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_source.h"

namespace importon {
namespace {

using Json = nlohmann::json;

constexpr const char* kCompressByExt = "compress by EXT_meshopt_compression, or not at all";
constexpr unsigned char kAttributeHeader = 0xA0;  // of version 0; the version stands in the low four bits

enum class MeshoptMode { attributes, triangles, indices };

/// What is to be decoded. The decoders assert the strides: check first.
struct MeshoptView {
  MeshoptMode mode = MeshoptMode::attributes;
  std::string filter;
  std::size_t count = 0;
  std::size_t stride = 0;
  const std::string& where;

  [[noreturn]] void fail(const std::string& what, const char* advice = kExportAgain) const {
    throw SceneError(what, where, advice);
  }

  void checkShape(std::size_t encodedBytes) const {
    const bool isAttribute = mode == MeshoptMode::attributes;
    const bool fits = isAttribute ? stride % 4 == 0 && stride >= 4 && stride <= 256 : stride == 2 || stride == 4;
    if (!fits) fail(fmt::format("a byteStride of {} is not one of this mode", stride));
    if (mode == MeshoptMode::triangles && count % 3 != 0) fail(fmt::format("{} indices make no triangles", count));
    constexpr std::size_t kMostExpansion = 64;
    if (count > kMostExpansion * encodedBytes / stride) {
      fail(fmt::format("{} elements of {} bytes cannot come of {} bytes", count, stride, encodedBytes));
    }
  }

  void checkFilter() const {
    if (filter == "NONE") return;
    if (filter == "COLOR") fail("the meshopt filter COLOR is not supported", kCompressByExt);
    const bool fits = filter == "OCTAHEDRAL"    ? stride == 4 || stride == 8
                      : filter == "QUATERNION"  ? stride == 8
                      : filter == "EXPONENTIAL" ? stride % 4 == 0
                                                : false;
    if (!fits || mode != MeshoptMode::attributes) {
      fail(fmt::format("the filter {} does not go with this mode and a byteStride of {}", printable(filter), stride));
    }
  }

  int decode(std::span<const unsigned char> from, std::vector<unsigned char>& to) const {
    switch (mode) {
      case MeshoptMode::triangles:
        return meshopt_decodeIndexBuffer(to.data(), count, stride, from.data(), from.size());
      case MeshoptMode::indices:
        return meshopt_decodeIndexSequence(to.data(), count, stride, from.data(), from.size());
      default:
        return meshopt_decodeVertexBuffer(to.data(), count, stride, from.data(), from.size());
    }
  }

  void applyFilter(std::vector<unsigned char>& bytes) const {
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
  }
};

MeshoptMode modeOf(const std::string& name) {
  if (name == "TRIANGLES") return MeshoptMode::triangles;
  return name == "INDICES" ? MeshoptMode::indices : MeshoptMode::attributes;
}

}  // namespace

const Json& meshoptExtension(const Json& view) {
  const Json& extension = member(view, "extensions", "EXT_meshopt_compression");
  return extension.is_object() ? extension : member(view, "extensions", "KHR_meshopt_compression");
}

bool isMeshoptFallback(const Json& buffer) { return booleanOr(meshoptExtension(buffer), "fallback", false); }

std::vector<unsigned char> decodeMeshopt(const Json& extension, std::span<const unsigned char> encoded,
                                         const std::string& where) {
  const MeshoptView view{modeOf(stringOr(extension, "mode", "")), stringOr(extension, "filter", "NONE"),
                         extension["count"].get<std::size_t>(), extension["byteStride"].get<std::size_t>(), where};
  view.checkShape(encoded.size());
  view.checkFilter();
  const bool isNewer = view.mode == MeshoptMode::attributes && !encoded.empty() &&
                       (encoded[0] & 0xF0u) == kAttributeHeader && encoded[0] != kAttributeHeader;
  if (isNewer) {
    view.fail(fmt::format("version {} of meshopt's attribute codec is not supported", encoded[0] & 0x0Fu),
              kCompressByExt);
  }
  std::vector<unsigned char> bytes(view.count * view.stride);
  if (view.decode(encoded, bytes) != 0) view.fail("the meshopt data cannot be decoded");
  view.applyFilter(bytes);
  return bytes;
}

}  // namespace importon
