#include "scene/container/gltf_source.h"

namespace importon {

std::string printable(std::string_view text, std::size_t longest) {
  std::string result;
  for (const char c : text.substr(0, longest)) {
    const auto code = static_cast<unsigned char>(c);
    result += code < 0x20 || code == 0x7f ? '?' : c;
  }
  if (text.size() > longest) result += "...";
  return result;
}

std::string GltfSource::at(std::string_view pointer) const { return name_ + "#" + std::string(pointer); }

std::string pointerToken(std::string_view key) {
  std::string escaped;
  for (const char c : key) {
    if (c == '~') {
      escaped += "~0";
    } else if (c == '/') {
      escaped += "~1";
    } else {
      escaped += c;
    }
  }
  return printable(escaped);
}

}  // namespace importon
