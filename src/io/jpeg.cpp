#include "io/jpeg.h"

#include <array>
#include <csetjmp>
#include <cstdlib>

// jpeglib.h needs FILE.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
// clang-format on

#include "base/error.h"
#include "io/output_file.h"
#include "io/tone_map.h"

namespace importon {
namespace {

/// libjpeg's error manager, and where to go on after an error.
struct ErrorManager {
  jpeg_error_mgr base{};  // first: libjpeg knows of nothing else
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] void keepJpegMessage(j_common_ptr jpeg) {
  auto* manager = reinterpret_cast<ErrorManager*>(jpeg->err);
  manager->base.format_message(jpeg, manager->message.data());
  std::longjmp(manager->jump, 1);
}

/// libjpeg's state, freed however writing ends. libjpeg jumps back to setjmp past any destructor: its methods have
/// nothing to destroy.
class JpegWriter {
 public:
  JpegWriter() {
    jpeg_.err = jpeg_std_error(&error_.base);
    error_.base.error_exit = keepJpegMessage;
    error_.base.emit_message = [](j_common_ptr, int) {};
    jpeg_create_compress(&jpeg_);
  }
  ~JpegWriter() {
    jpeg_destroy_compress(&jpeg_);
    std::free(bytes_);
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  /// False after an error.
  bool write(const PngPixels& pixels) {
    constexpr int kQuality = 95;  // of 100: no blocks to be seen
    if (setjmp(error_.jump) != 0) {
      bytes_ = nullptr;  // libjpeg may have replaced them, and does not tell before the end
      return false;
    }
    jpeg_mem_dest(&jpeg_, &bytes_, &size_);
    jpeg_.image_width = static_cast<JDIMENSION>(pixels.width);
    jpeg_.image_height = static_cast<JDIMENSION>(pixels.height);
    jpeg_.input_components = 3;
    jpeg_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, kQuality, TRUE);
    jpeg_.comp_info[0].h_samp_factor = jpeg_.comp_info[0].v_samp_factor = 1;  // colour of each pixel, as brightness
    jpeg_.optimize_coding = TRUE;
    jpeg_start_compress(&jpeg_, TRUE);
    while (jpeg_.next_scanline < jpeg_.image_height) {
      const std::size_t at = std::size_t{3} * jpeg_.next_scanline * jpeg_.image_width;
      auto* row = const_cast<JSAMPROW>(pixels.rgb.data() + at);  // libjpeg only reads it
      jpeg_write_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_compress(&jpeg_);
    return true;
  }

  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(bytes_, size_)); }
  [[nodiscard]] const char* message() const { return error_.message.data(); }

 private:
  ErrorManager error_;
  jpeg_compress_struct jpeg_{};
  unsigned char* bytes_ = nullptr;
  unsigned long size_ = 0;
};

/// Channels R, G, B alone.
Image withoutAlpha(const Image& image, const std::string& where) {
  Image colors{image.width, image.height, {}, {}};
  const auto rgb = rgbOf(image, where);
  for (std::size_t c = 0; c < 3; ++c)
    colors.channels.push_back({std::string(1, "RGB"[c]), {rgb[c].begin(), rgb[c].end()}});
  return colors;
}

}  // namespace

std::vector<std::byte> encodeJpeg(const PngPixels& pixels, const std::string& where) {
  constexpr int kLongestSide = 65500;  // JPEG_MAX_DIMENSION of most readers
  if (pixels.width > kLongestSide || pixels.height > kLongestSide)
    throw OutputError("a JPEG has at most 65500 pixels along a side", where, "write a PNG, or a smaller image");
  JpegWriter writer;
  if (!writer.write(pixels))
    throw OutputError(std::string("cannot encode JPEG: ") + writer.message(), where, "write a PNG");
  return {writer.bytes().begin(), writer.bytes().end()};
}

void writeJpeg(const std::filesystem::path& file, const Image& image, const Look& look) {
  OutputFile output(file);  // first: an error that leaves nothing behind
  const std::string where = file.string();
  const Image colors = withoutAlpha(image, where);
  output.write(encodeJpeg(shownPixels(colors, exposureOf(look, colors, where), look.toneMap, where), where));
  output.commit();
}

}  // namespace importon
