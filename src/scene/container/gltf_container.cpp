#include "scene/container/gltf_container.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "base/error.h"

namespace importon {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr const char* kCopyAgain = "copy or export the file again";

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string_view text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The payload of the chunk that starts at `offset`.
std::span<const std::byte> chunk(std::span<const std::byte> file, std::size_t offset, std::uint32_t type,
                                 const char* name, const GltfSource& source) {
  if (file.size() - offset < kChunkHeaderBytes) {
    throw SceneError(fmt::format("the .glb ends before its {} chunk", name), source.name(), kCopyAgain);
  }
  const std::size_t length = word(file, offset);
  if (word(file, offset + 4) != type) {
    throw SceneError(fmt::format("the .glb has no {} chunk at byte {}", name, offset), source.name(), kCopyAgain);
  }
  if (length > file.size() - offset - kChunkHeaderBytes) {
    throw SceneError(fmt::format("the {} chunk of {} bytes reaches past the end of the .glb", name, length),
                     source.name(), kCopyAgain);
  }
  return file.subspan(offset + kChunkHeaderBytes, length);
}

GltfContainer readBinary(std::span<const std::byte> bytes, const GltfSource& source) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) {
    throw SceneError("the .glb is cut off in its header", source.name(), kCopyAgain);
  }
  if (word(bytes, 4) != 2) {
    throw SceneError(fmt::format("the .glb has version {}", word(bytes, 4)), source.name(), "convert it to glTF 2.0");
  }
  const std::size_t length = word(bytes, 8);
  if (length > bytes.size() || length < kHeaderBytes + kChunkHeaderBytes) {
    throw SceneError(fmt::format("the .glb says it has {} bytes but has {}", length, bytes.size()), source.name(),
                     kCopyAgain);
  }
  const std::span<const std::byte> file = bytes.first(length);
  const std::span<const std::byte> json = chunk(file, kHeaderBytes, kJsonChunk, "JSON", source);
  GltfContainer container{true, text(json), std::nullopt};
  const std::size_t next = kHeaderBytes + kChunkHeaderBytes + json.size();
  if (next < file.size()) container.binaryChunk = chunk(file, next, kBinChunk, "BIN", source);
  return container;
}

/// Parsers and destructors of JSON values recurse: a document of a million brackets must not reach them.
void checkDepth(std::string_view json, const GltfSource& source) {
  constexpr int kDeepest = 64;
  int depth = 0;
  bool isInString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (isInString) {
      if (c == '\\') ++i;
      isInString = c != '"';
    } else if (c == '"') {
      isInString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) {
        throw SceneError(fmt::format("the JSON is nested deeper than {} levels", kDeepest), source.name(),
                         "remove deeply nested extras");
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

}  // namespace

GltfContainer readContainer(std::span<const std::byte> bytes, const GltfSource& source) {
  if (bytes.empty()) throw SceneError("the file is empty", source.name(), kCopyAgain);
  if (bytes.size() > std::numeric_limits<std::int32_t>::max()) {
    throw SceneError("the file is larger than 2 GiB", source.name(), "keep buffers and images in files of their own");
  }
  const bool isBinary = bytes.size() >= 4 && word(bytes, 0) == kMagic;
  const GltfContainer container = isBinary ? readBinary(bytes, source) : GltfContainer{false, text(bytes), {}};
  checkDepth(container.json, source);
  return container;
}

}  // namespace importon
