/// PNG of 16 bits a channel, which libpng's simple calls have in linear light alone.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace importon {

class DeepPngWriter {
 public:
  /// sRGB, three samples a pixel or, with opacity, four; `perRow` of them in a row. False after an error.
  bool write(std::span<const std::uint16_t> samples, std::size_t perRow, std::uint32_t width, std::uint32_t height);

  [[nodiscard]] std::vector<std::byte> bytes() const { return bytes_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  std::vector<std::byte> bytes_;
  std::string message_;
};

}  // namespace importon
