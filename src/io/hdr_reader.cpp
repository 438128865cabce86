#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>

#include "base/error.h"
#include "io/image.h"

namespace importon {
namespace {

constexpr std::size_t kLargestSide = 65536;
/// The old run lengths may say anything of any size, so that a picture is held against its file before there is memory
/// for it: all but pictures of one colour pack less densely.
constexpr std::size_t kMostPixelsPerByte = 256;

using Pixel = std::array<std::uint8_t, 4>;  // red, green, blue, exponent

/// One axis of the picture: where its lines, or the pixels of a line, go.
struct Axis {
  bool isDown = false;  // of y; else x
  bool isRising = false;
  std::size_t length = 0;
};

class HdrReader {
 public:
  HdrReader(std::span<const unsigned char> bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  Image read() {
    readVariables();
    readSize();
    Image image{static_cast<int>(width()), static_cast<int>(height()), {}, {}};
    for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>(width() * height())});
    std::vector<Pixel> line(across_.length);
    for (std::size_t i = 0; i < lines_.length; ++i) {
      readLine(line);
      for (std::size_t k = 0; k < line.size(); ++k) put(image, i, k, line[k]);
    }
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw SceneError(what, where_, "export the picture again"); }
  [[nodiscard]] std::size_t width() const { return lines_.isDown ? across_.length : lines_.length; }
  [[nodiscard]] std::size_t height() const { return lines_.isDown ? lines_.length : across_.length; }

  std::string_view textLine() {
    const auto rest = bytes_.subspan(at_);
    const auto end = std::find(rest.begin(), rest.end(), '\n');
    if (end == rest.end()) fail("the header of the picture ends too early");
    const auto length = static_cast<std::size_t>(end - rest.begin());
    const std::string_view line(reinterpret_cast<const char*>(rest.data()), length);
    at_ += length + 1;
    return line.ends_with('\r') ? line.substr(0, length - 1) : line;
  }

  static std::optional<double> numberIn(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    return read.ec == std::errc() ? std::optional(value) : std::nullopt;
  }

  /// Up to the empty line. Exposures are factors that pixels were multiplied by, all of them.
  void readVariables() {
    if (!textLine().starts_with("#?")) fail("this is no Radiance picture");
    for (std::string_view line = textLine(); !line.empty(); line = textLine()) {
      if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
        fail("the picture is not in RGBE but in another format");
      if (!line.starts_with("EXPOSURE=")) continue;
      const std::optional<double> exposure = numberIn(line.substr(9));
      if (!exposure || !(*exposure > 0) || !std::isfinite(*exposure))
        fail("an exposure of the picture is not a number above 0");
      scale_ /= *exposure;
    }
    if (!(scale_ > 0) || !std::isfinite(scale_)) fail("the exposures of the picture make no sense");
  }

  Axis axisOf(std::string_view sign, std::string_view length) const {
    Axis axis;
    if (sign.size() == 2 && (sign[0] == '-' || sign[0] == '+') && (sign[1] == 'X' || sign[1] == 'Y')) {
      axis.isDown = sign[1] == 'Y';
      axis.isRising = (sign[0] == '+') != axis.isDown;  // y is up, rows go down
      const auto read = std::from_chars(length.data(), length.data() + length.size(), axis.length);
      if (read.ec == std::errc() && read.ptr == length.data() + length.size() && axis.length >= 1 &&
          axis.length <= kLargestSide)
        return axis;
    }
    fail(fmt::format("the size of the picture is none of 1 to {} pixels a side", kLargestSide));
  }

  void readSize() {
    std::string_view line = textLine();
    std::array<std::string_view, 4> words;
    for (std::string_view& word : words) {
      line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
      word = line.substr(0, line.find(' '));
      line.remove_prefix(word.size());
    }
    lines_ = axisOf(words[0], words[1]);
    across_ = axisOf(words[2], words[3]);
    if (lines_.isDown == across_.isDown) fail("the size of the picture names one axis twice");
    if (width() * height() > kMostPixelsPerByte * (bytes_.size() - at_))
      fail(fmt::format("the file is too short to hold {} x {} pixels", width(), height()));
  }

  std::uint8_t byte() {
    if (at_ == bytes_.size()) fail("the pixels of the picture end too early");
    return bytes_[at_++];
  }

  Pixel pixel() {
    Pixel pixel;
    for (std::uint8_t& part : pixel) part = byte();
    return pixel;
  }

  void readLine(std::span<Pixel> line) {
    constexpr std::size_t kLeastPacked = 8, kMostPacked = 0x7FFF;
    const Pixel first = pixel();
    const bool isPacked =
        line.size() >= kLeastPacked && line.size() <= kMostPacked && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (!isPacked) return readOldLine(first, line);
    if ((std::size_t{first[2]} << 8 | first[3]) != line.size()) fail("a line of the picture has another length");
    for (std::size_t part = 0; part < first.size(); ++part) readPart(part, line);
  }

  /// Runs of one part of the pixels: a count above 128 repeats a byte, another one says how many bytes follow.
  void readPart(std::size_t part, std::span<Pixel> line) {
    for (std::size_t i = 0; i < line.size();) {
      const std::uint8_t code = byte();
      const bool isRun = code > 128;
      const std::size_t count = isRun ? code - 128u : code;
      if (count == 0 || count > line.size() - i) fail("a run of pixels does not fit its line");
      const std::uint8_t repeated = isRun ? byte() : std::uint8_t{0};
      for (const std::size_t end = i + count; i < end; ++i) line[i][part] = isRun ? repeated : byte();
    }
  }

  /// Whole pixels; (1, 1, 1, n) repeats the last one n times, 256 n where it follows another repetition, and so on.
  void readOldLine(const Pixel& first, std::span<Pixel> line) {
    constexpr unsigned kMostShift = 24;
    unsigned shift = 0;
    Pixel next = first;
    for (std::size_t i = 0; i < line.size();) {
      const bool isRun = next[0] == 1 && next[1] == 1 && next[2] == 1;
      const std::size_t count = isRun ? std::size_t{next[3]} << shift : 1;
      if (isRun && (i == 0 || shift > kMostShift || count > line.size() - i))
        fail("a run of pixels does not fit its line");
      std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(i), count, isRun ? line[i - 1] : next);
      i += count;
      shift = isRun ? shift + 8 : 0;
      if (i < line.size()) next = pixel();
    }
  }

  void put(Image& image, std::size_t line, std::size_t place, const Pixel& pixel) const {
    const std::size_t first = lines_.isRising ? line : lines_.length - 1 - line;
    const std::size_t second = across_.isRising ? place : across_.length - 1 - place;
    const std::size_t at = lines_.isDown ? first * width() + second : second * width() + first;
    const double unit = pixel[3] == 0 ? 0 : std::ldexp(scale_, pixel[3] - 136);
    for (std::size_t c = 0; c < 3; ++c) image.channels[c].values[at] = static_cast<float>(pixel[c] * unit);
  }

  std::span<const unsigned char> bytes_;
  const std::string& where_;
  std::size_t at_ = 0;
  double scale_ = 1;
  Axis lines_, across_;
};

}  // namespace

bool isHdr(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return in.get() == '#' && in.get() == '?';
}

Image decodeHdr(std::span<const unsigned char> bytes, const std::string& where) {
  return HdrReader(bytes, where).read();
}

Image readHdr(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw SceneError("the file cannot be opened", file.string(), "check the path");
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(in), {}};
  return decodeHdr(bytes, file.string());
}

}  // namespace importon
