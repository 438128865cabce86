/// The state of a render between two passes, as a file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace importon {

/// A piece of the state.
struct CheckpointBlock {
  std::string name;
  std::vector<std::byte> bytes;
};

struct Checkpoint {
  std::uint64_t fingerprint = 0;  // of the run: all that decides the bits of the image but the number of passes
  int passes = 0;                 // done
  std::vector<CheckpointBlock> blocks;

  /// Of that name; nullptr if there is none.
  [[nodiscard]] const CheckpointBlock* find(const std::string& name) const;
};

/// Little-endian: a magic line, the fingerprint, passes and number of blocks, each block with its name, and a hash
/// of it all. Under a temporary name that is renamed at the end. Throws OutputError.
void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws SceneError where the file is missing, no checkpoint of this version, or torn.
[[nodiscard]] Checkpoint readCheckpoint(const std::filesystem::path& file);

}  // namespace importon
