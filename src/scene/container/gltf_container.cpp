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

struct Chunk {
  std::uint32_t type = 0;
  std::span<const std::byte> payload;
  std::size_t end = 0;  // byte of the file after it
};

/// The chunk that starts at `offset`; empty if none of at most the rest of the file does.
std::optional<Chunk> chunkAt(std::span<const std::byte> file, std::size_t offset) {
  if (offset > file.size() || file.size() - offset < kChunkHeaderBytes) return std::nullopt;
  const std::size_t length = word(file, offset), first = offset + kChunkHeaderBytes;
  if (length > file.size() - first) return std::nullopt;
  return Chunk{word(file, offset + 4), file.subspan(first, length), first + length};
}

/// The JSON chunk, which comes first.
Chunk jsonChunk(std::span<const std::byte> file, const GltfSource& source) {
  const std::size_t length = word(file, kHeaderBytes);
  if (word(file, kHeaderBytes + 4) != kJsonChunk) {
    throw SceneError(fmt::format("the .glb has no JSON chunk at byte {}", kHeaderBytes), source.name(), kCopyAgain);
  }
  const std::optional<Chunk> chunk = chunkAt(file, kHeaderBytes);
  if (chunk) return *chunk;
  throw SceneError(fmt::format("the JSON chunk of {} bytes reaches past the end of the .glb", length), source.name(),
                   kCopyAgain);
}

/// The chunk at `offset`, or at the next multiple of 4 where the one before is not padded as it should be.
std::optional<Chunk> nextChunk(std::span<const std::byte> file, std::size_t offset, const Faults& faults) {
  const std::size_t aligned = (offset + 3) / 4 * 4;
  const std::optional<Chunk> padded = chunkAt(file, aligned);
  if (offset == aligned || (padded && padded->type == kBinChunk)) return padded;
  const std::optional<Chunk> chunk = chunkAt(file, offset);
  if (chunk) {
    faults.forgive("chunk without padding", "", fmt::format("a chunk of the .glb starts at byte {}", offset),
                   "it is read there, though not at a multiple of 4");
  }
  return chunk;
}

/// The first BIN chunk from `offset` on; others are passed over (glTF 2.0, section 4.4.3).
std::optional<std::span<const std::byte>> binaryChunk(std::span<const std::byte> file, std::size_t offset,
                                                      const GltfSource& source, const Faults& faults, Log& log) {
  while (offset < file.size()) {
    const std::optional<Chunk> chunk = nextChunk(file, offset, faults);
    if (!chunk && file.size() - offset < kChunkHeaderBytes) return std::nullopt;
    if (!chunk) {
      const char* name = word(file, offset + 4) == kBinChunk ? "BIN " : "";
      throw SceneError(fmt::format("the {}chunk at byte {} reaches past the end of the .glb", name, offset),
                       source.name(), kCopyAgain);
    }
    if (chunk->type == kBinChunk) return chunk->payload;
    log.warn("unknown chunk", fmt::format("{}: a chunk of {} bytes of unknown kind is passed over", source.name(),
                                          chunk->payload.size()));
    offset = chunk->end;
  }
  return std::nullopt;
}

GltfContainer readBinary(std::span<const std::byte> bytes, const GltfSource& source, const Faults& faults, Log& log) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) {
    throw SceneError("the .glb is cut off in its header", source.name(), kCopyAgain);
  }
  if (word(bytes, 4) != 2) {
    throw SceneError(fmt::format("the .glb has version {}", word(bytes, 4)), source.name(), "convert it to glTF 2.0");
  }
  const std::size_t length = word(bytes, 8);
  const Chunk json = jsonChunk(bytes, source);
  const bool isSane = length <= bytes.size() && length >= json.end;
  if (!isSane) {
    faults.forgive("wrong length of a .glb", "",
                   fmt::format("the .glb says it has {} bytes but has {}", length, bytes.size()),
                   "it is read by its chunks");
  }
  const std::span<const std::byte> file = isSane ? bytes.first(length) : bytes;
  return {true, text(json.payload), binaryChunk(file, json.end, source, faults, log)};
}

}  // namespace

GltfContainer readContainer(std::span<const std::byte> bytes, const GltfSource& source, const Faults& faults,
                            Log& log) {
  if (bytes.empty()) throw SceneError("the file is empty", source.name(), kCopyAgain);
  if (bytes.size() > std::numeric_limits<std::int32_t>::max()) {
    throw SceneError("the file is larger than 2 GiB", source.name(), "keep buffers and images in files of their own");
  }
  const bool isBinary = bytes.size() >= 4 && word(bytes, 0) == kMagic;
  return isBinary ? readBinary(bytes, source, faults, log) : GltfContainer{false, text(bytes), {}};
}

}  // namespace importon
