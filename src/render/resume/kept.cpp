#include "render/resume/kept.h"

#include "base/error.h"

namespace importon {

Kept keep(std::string name, gpu::Buffer& buffer) {
  const auto save = [&buffer] {
    std::vector<std::byte> bytes(buffer.bytes());
    buffer.downloadBytes(bytes);
    return bytes;
  };
  const auto restore = [&buffer](std::span<const std::byte> bytes) {
    if (bytes.size() != buffer.bytes()) return false;
    buffer.uploadBytes(bytes);
    return true;
  };
  return {std::move(name), save, restore};
}

std::vector<CheckpointBlock> blocksOf(const std::vector<Kept>& state) {
  std::vector<CheckpointBlock> blocks;
  for (const Kept& kept : state) blocks.push_back({kept.name, kept.save()});
  return blocks;
}

void restore(const std::vector<Kept>& state, const Checkpoint& checkpoint, const std::filesystem::path& file) {
  for (const Kept& kept : state) {
    const CheckpointBlock* block = checkpoint.find(kept.name);
    if (block == nullptr || !kept.restore(block->bytes))
      throw SceneError("the checkpoint has no fitting " + kept.name, file.string(), "start again without --resume");
  }
}

}  // namespace importon
