#include "io/deep_png_writer.h"

#include <png.h>

#include <csetjmp>

namespace importon {
namespace {

/// What libpng's callbacks share.
struct Writing {
  std::vector<std::byte>& bytes;
  std::string& message;
};

void keepBytes(png_structp png, png_bytep data, std::size_t count) {
  auto& writing = *static_cast<Writing*>(png_get_io_ptr(png));
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  writing.bytes.insert(writing.bytes.end(), begin, begin + count);
}

[[noreturn]] void keepMessage(png_structp png, png_const_charp message) {
  static_cast<Writing*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

/// libpng's state, freed however writing ends.
struct PngState {
  explicit PngState(Writing& writing)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &writing, keepMessage, [](png_structp, png_const_charp) {})),
        info(png == nullptr ? nullptr : png_create_info_struct(png)) {
    if (info != nullptr) png_set_write_fn(png, &writing, keepBytes, [](png_structp) {});
  }
  ~PngState() { png_destroy_write_struct(&png, &info); }
  PngState(const PngState&) = delete;
  PngState& operator=(const PngState&) = delete;

  png_structp png;
  png_infop info;
};

}  // namespace

/// libpng jumps back to setjmp past any destructor: between there and the end nothing has one.
bool DeepPngWriter::write(std::span<const std::uint16_t> samples, std::size_t perRow, std::uint32_t width,
                          std::uint32_t height) {
  Writing writing{bytes_, message_};
  const PngState state(writing);
  if (state.info == nullptr) return false;
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  png_set_IHDR(state.png, state.info, width, height, 16,
               perRow == std::size_t{4} * width ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(state.png, state.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(state.png, state.info);
  png_set_swap(state.png);  // to big-endian
  for (std::size_t at = 0; at < samples.size(); at += perRow)
    png_write_row(state.png, reinterpret_cast<png_const_bytep>(samples.data() + at));
  png_write_end(state.png, nullptr);
  return true;
}

}  // namespace importon
