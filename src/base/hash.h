/// A 64-bit hash of contents: for telling files and scenes apart, not for security.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace importon {

/// FNV-1a (Fowler, Noll and Vo: offset basis 0xcbf29ce484222325, prime 0x100000001b3) over 8-byte words instead
/// of bytes, each word mixed down first, with the length added at the end of each piece: {"ab","c"} and
/// {"a","bc"} differ. Little-endian words, so the same on every machine we run on.
class ContentHash {
 public:
  void add(std::span<const std::byte> bytes) {
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) addWord(load(bytes.data() + i, 8));
    if (i < bytes.size()) addWord(load(bytes.data() + i, bytes.size() - i));
    addWord(bytes.size());
  }
  void add(std::string_view text) { add(std::as_bytes(std::span(text))); }

  [[nodiscard]] std::uint64_t value() const {
    const std::uint64_t folded = (state_ ^ (state_ >> 32)) * 0x9e3779b97f4a7c15u;
    return folded ^ (folded >> 29);
  }

 private:
  static_assert(std::endian::native == std::endian::little);
  static std::uint64_t load(const std::byte* from, std::size_t bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, from, bytes);
    return word;
  }
  // Multiplying only carries bits upwards; the rotation brings the upper ones back down.
  void addWord(std::uint64_t word) { state_ = std::rotl((state_ ^ word) * 0x100000001b3u, 29) * 0x9e3779b97f4a7c15u; }

  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace importon
