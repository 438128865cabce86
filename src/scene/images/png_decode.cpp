#include "scene/images/png_decode.h"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "base/error.h"

namespace importon {
namespace {

constexpr const char* kSavePngAgain = "save the image as PNG again";

std::size_t bigEndian(std::span<const unsigned char> bytes, std::size_t offset) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[offset + i];
  return value;
}

/// What libpng's callbacks share.
struct Reading {
  std::span<const unsigned char> rest;
  std::array<char, 120> message{};
};

void readBytes(png_structp png, png_bytep out, std::size_t count) {
  auto& reading = *static_cast<Reading*>(png_get_io_ptr(png));
  if (count > reading.rest.size()) png_error(png, "the data end early");
  std::memcpy(out, reading.rest.data(), count);
  reading.rest = reading.rest.subspan(count);
}

[[noreturn]] void keepPngMessage(png_structp png, png_const_charp message) {
  auto& reading = *static_cast<Reading*>(png_get_error_ptr(png));
  std::strncpy(reading.message.data(), message, reading.message.size() - 1);
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// libpng's state, freed however reading ends.
class PngReader {
 public:
  explicit PngReader(Reading& reading) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, keepPngMessage, ignoreWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ != nullptr) png_set_read_fn(png_, &reading, readBytes);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Decodes into `rows`; false after an error. libpng jumps back to setjmp past any destructor: nothing here
  /// has one.
  bool read(png_bytepp rows, png_uint_32 width, png_uint_32 height, TexelDepth depth) {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, width, height);
    png_read_info(png_, info_);
    if (png_get_image_width(png_, info_) != width || png_get_image_height(png_, info_) != height) {
      png_error(png_, "two headers");
    }
    png_set_expand(png_);
    if (depth == TexelDepth::eight) {
      png_set_strip_16(png_);
    } else {
      png_set_swap(png_);  // from big-endian
    }
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xFFFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != (depth == TexelDepth::eight ? std::size_t{4} : std::size_t{8}) * width)
      png_error(png_, "unexpected rows");
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

 private:
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

bool isPng(std::span<const unsigned char> bytes) {
  constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  return bytes.size() >= kSignature.size() && std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) == 0;
}

ImageSize readPngSize(std::span<const unsigned char> bytes, const std::string& where) {
  constexpr std::size_t kHeaderBytes = 25;  // signature, length and type of IHDR, width, height, bit depth
  if (bytes.size() < kHeaderBytes || std::memcmp(bytes.data() + 12, "IHDR", 4) != 0) {
    throw SceneError("the PNG has no header", where, kSavePngAgain);
  }
  return {bigEndian(bytes, 16), bigEndian(bytes, 20), bytes[24] == 16};
}

void decodePng(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where,
               TexelDepth depth) {
  const ImageSize size = readPngSize(bytes, where);
  const std::size_t words = depth == TexelDepth::eight ? 1 : 2;
  std::vector<png_bytep> rows(size.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = reinterpret_cast<png_bytep>(&texels[y * size.width * words]);
  Reading reading{bytes, {}};
  PngReader reader(reading);
  if (reader.read(rows.data(), static_cast<png_uint_32>(size.width), static_cast<png_uint_32>(size.height), depth))
    return;
  throw SceneError(fmt::format("the PNG cannot be decoded ({})", reading.message.data()), where, kSavePngAgain);
}

}  // namespace importon
