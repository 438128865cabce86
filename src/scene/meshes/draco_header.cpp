#include "scene/meshes/draco_header.h"

#include <draco/compression/config/compression_shared.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/geometry_metadata.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "scene/container/gltf_advice.h"

namespace importon {
namespace {

/// Reads up to the counts, in the order of the Draco bitstream specification, sections 3 and 4.
class DracoHeader {
 public:
  explicit DracoHeader(std::span<const unsigned char> stream) {
    buffer_.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  }

  bool read() {
    char magic[5];
    std::uint8_t major = 0, minor = 0, kind = 0, method = 0, traversal = 0;
    std::uint16_t flags = 0;
    const bool isMesh = buffer_.Decode(magic, sizeof magic) && std::memcmp(magic, "DRACO", sizeof magic) == 0 &&
                        buffer_.Decode(&major) && buffer_.Decode(&minor) && buffer_.Decode(&kind) &&
                        buffer_.Decode(&method) && buffer_.Decode(&flags) && kind == draco::TRIANGULAR_MESH;
    if (!isMesh) return false;
    const auto version = static_cast<std::uint16_t>(DRACO_BITSTREAM_VERSION(major, minor));
    buffer_.set_bitstream_version(version);
    if ((flags & METADATA_FLAG_MASK) != 0 && !skipMetadata()) return false;
    constexpr std::uint16_t kVersion20 = DRACO_BITSTREAM_VERSION(2, 0), kVersion22 = DRACO_BITSTREAM_VERSION(2, 2);
    if (method == draco::MESH_SEQUENTIAL_ENCODING) {
      return readCount(version >= kVersion22, faces) && readCount(version >= kVersion22, points);
    }
    std::uint32_t added = 0;  // vertices that splits made, in older versions
    return buffer_.Decode(&traversal) && (version >= kVersion22 || readCount(version >= kVersion20, added)) &&
           readCount(version >= kVersion20, points) && readCount(version >= kVersion20, faces);
  }

  std::uint32_t faces = 0, points = 0;

 private:
  bool skipMetadata() {
    draco::GeometryMetadata metadata;
    return draco::MetadataDecoder().DecodeGeometryMetadata(&buffer_, &metadata);
  }

  bool readCount(bool isVarint, std::uint32_t& count) {
    return isVarint ? draco::DecodeVarint(&count, &buffer_) : buffer_.Decode(&count);
  }

  draco::DecoderBuffer buffer_;
};

}  // namespace

void checkDracoHeader(std::span<const unsigned char> stream, const std::string& where) {
  DracoHeader header(stream);
  if (!header.read()) throw SceneError("the Draco data have no header of a mesh", where, kExportAgain);
  constexpr std::size_t kMost = std::size_t{1} << 26, kMostPerByte = 1024;
  const std::size_t most = std::min(kMost, kMostPerByte * stream.size());
  if (header.faces <= most && header.points <= most) return;
  throw SceneError(fmt::format("the Draco data declare {} triangles and {} points in {} bytes", header.faces,
                               header.points, stream.size()),
                   where, kExportAgain);
}

}  // namespace importon
