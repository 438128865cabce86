#include "report/page.h"

#include <cstdint>
#include <span>
#include <stdexcept>

namespace importon {
namespace {

std::string base64(std::span<const std::byte> bytes) {  // RFC 4648, section 4
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string dataUri(const PngPixels& pixels) {
  return "data:image/png;base64," + base64(encodePng(pixels, "a page's image"));
}

std::string fillPage(std::string_view page, const std::string& json) {
  constexpr std::string_view kMark = "@DATA@";
  const std::size_t mark = page.find(kMark);
  if (mark == std::string_view::npos) throw std::logic_error("the page has no mark for its data");
  std::string filled(page.substr(0, mark));
  for (const char c : json) filled += c == '<' ? "\\u003c" : std::string(1, c);
  return filled.append(page.substr(mark + kMark.size()));
}

}  // namespace importon
