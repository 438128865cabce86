#include "io/exr_header.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "base/error.h"

namespace importon {
namespace {

constexpr std::uint32_t kMagic = 20000630, kIsMultiPart = 1u << 12;

struct TypeSize {
  std::string_view type;
  std::uint64_t bytes;
};
constexpr std::array<TypeSize, 24> kTypeSizes = {{{"box2f", 16},
                                                  {"box2i", 16},
                                                  {"chromaticities", 32},
                                                  {"compression", 1},
                                                  {"deepImageState", 1},
                                                  {"double", 8},
                                                  {"envmap", 1},
                                                  {"float", 4},
                                                  {"int", 4},
                                                  {"keycode", 28},
                                                  {"lineOrder", 1},
                                                  {"m33d", 72},
                                                  {"m33f", 36},
                                                  {"m44d", 128},
                                                  {"m44f", 64},
                                                  {"rational", 8},
                                                  {"tiledesc", 9},
                                                  {"timecode", 8},
                                                  {"v2d", 16},
                                                  {"v2f", 8},
                                                  {"v2i", 8},
                                                  {"v3d", 24},
                                                  {"v3f", 12},
                                                  {"v3i", 12}}};

class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& file, const std::string& where)
      : in_(file, std::ios::binary), where_(where), left_(std::filesystem::file_size(file)) {}

  void check() {
    if (readWord() != kMagic) return;
    const bool isMultiPart = (readWord() & kIsMultiPart) != 0;
    bool isStart = true;  // of a part's header; an empty name ends it, and an empty header ends them all
    while (in_) {
      if (readText().empty()) {
        if (isStart || !isMultiPart) return;
        isStart = true;
      } else {
        isStart = false;
        checkValue(readText());
      }
    }
  }

 private:
  /// Little-endian.
  std::uint32_t readWord() {
    unsigned char bytes[4] = {};
    in_.read(reinterpret_cast<char*>(bytes), sizeof bytes);
    take(sizeof bytes);
    return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
  }

  /// Up to a NUL.
  std::string readText() {
    constexpr std::size_t kLongest = 255;
    std::string text;
    std::getline(in_, text, '\0');
    take(text.size() + 1);
    if (text.size() > kLongest) fail();
    return text;
  }

  void checkValue(const std::string& type) {
    const std::uint64_t bytes = readWord();
    if (!in_) return;
    if (bytes > left_) fail();
    for (const TypeSize& known : kTypeSizes)
      if (known.type == type && known.bytes != bytes) fail();
    const std::uint64_t end = left_ - bytes;
    if (type == "chlist") skipChannels();
    if (type == "preview") skipPreview();
    if ((type == "chlist" || type == "preview") && left_ != end) fail();
    skip(left_ - end);
  }

  /// Each a name and four numbers; an empty name ends them.
  void skipChannels() {
    constexpr std::uint64_t kNumbers = 16;
    while (in_ && !readText().empty()) skip(kNumbers);
  }

  /// Width, height, and four bytes a pixel.
  void skipPreview() {
    const std::uint64_t width = readWord(), height = readWord();
    if (width > left_ || height > left_) fail();  // the product must not wrap
    skip(4 * width * height);
  }

  void skip(std::uint64_t bytes) {
    if (bytes > left_) fail();
    in_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    take(bytes);
  }

  void take(std::uint64_t bytes) {
    if (bytes > left_) fail();
    left_ -= bytes;
  }

  [[noreturn]] void fail() const {
    throw SceneError("the header of the OpenEXR file is damaged", where_, "check that the file is whole");
  }

  std::ifstream in_;
  const std::string& where_;
  std::uint64_t left_;
};

}  // namespace

void checkExrHeader(const std::filesystem::path& file, const std::string& where) { HeaderReader(file, where).check(); }

}  // namespace importon
