/// What lasts from pass to pass, as each owner says it of itself: all that a checkpoint must hold.
#pragma once
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "gpu/buffer.h"
#include "render/resume/checkpoint.h"

namespace importon {

struct Kept {
  std::string name;
  std::function<std::vector<std::byte>()> save;
  std::function<bool(std::span<const std::byte>)> restore;  // false: these are not bytes of such a state
};

/// A device's memory, which must stay where it is.
[[nodiscard]] Kept keep(std::string name, gpu::Buffer& buffer);

/// A value of the host, which must stay where it is.
template <class T>
requires std::is_trivially_copyable_v<T>
[[nodiscard]] Kept keep(std::string name, T& value) {
  const auto save = [&value] {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  const auto restore = [&value](std::span<const std::byte> bytes) {
    if (bytes.size() != sizeof value) return false;
    std::memcpy(static_cast<void*>(&value), bytes.data(), sizeof value);
    return true;
  };
  return {std::move(name), save, restore};
}

[[nodiscard]] std::vector<CheckpointBlock> blocksOf(const std::vector<Kept>& state);

/// Takes up the state. `file`: the checkpoint's, for the SceneError that is thrown if it does not fit.
void restore(const std::vector<Kept>& state, const Checkpoint& checkpoint, const std::filesystem::path& file);

}  // namespace importon
