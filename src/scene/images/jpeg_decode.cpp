#include "scene/images/jpeg_decode.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstddef>

// jpeglib.h needs FILE.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include "base/error.h"

namespace importon {
namespace {

constexpr const char* kSaveJpegAgain = "save the image as JPEG again";

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

/// Warnings pass, but for data that end early: libjpeg would fill up with grey.
void ignoreMessage(j_common_ptr jpeg, int level) {
  if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) keepJpegMessage(jpeg);
}

/// Of a row of cyan, magenta, yellow and black makes RGBA, without a profile: what passes the colour and the black.
/// Adobe's files hold the light that passes, others the ink. [Adobe technical note 5116, on the transform flag]
void mixInks(JSAMPROW row, JDIMENSION width, bool isLight) {
  for (JDIMENSION x = 0; x < width; ++x, row += 4) {
    for (int c = 0; c < 4; ++c) row[c] = static_cast<JSAMPLE>(isLight ? row[c] : 255 - row[c]);
    for (int c = 0; c < 3; ++c) row[c] = static_cast<JSAMPLE>((row[c] * row[3] + 127) / 255);
    row[3] = 255;
  }
}

/// libjpeg's state, freed however reading ends. libjpeg jumps back to setjmp past any destructor: its methods
/// have nothing to destroy.
class JpegReader {
 public:
  JpegReader() {
    jpeg_.err = jpeg_std_error(&error_.base);
    error_.base.error_exit = keepJpegMessage;
    error_.base.emit_message = ignoreMessage;
    jpeg_create_decompress(&jpeg_);
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool readHeader(const unsigned char* bytes, std::size_t count) {
    if (setjmp(error_.jump) != 0) return false;
    jpeg_mem_src(&jpeg_, bytes, static_cast<unsigned long>(count));
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }

  /// After readHeader. `texels` holds size().texels().
  bool read(uint* texels) {
    if (setjmp(error_.jump) != 0) return false;
    const bool hasInks = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    jpeg_.out_color_space = hasInks ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      const std::size_t row = jpeg_.output_scanline;
      auto* line = reinterpret_cast<JSAMPROW>(texels + row * jpeg_.output_width);
      jpeg_read_scanlines(&jpeg_, &line, 1);
      if (hasInks) mixInks(line, jpeg_.output_width, jpeg_.saw_Adobe_marker != 0);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  [[nodiscard]] ImageSize size() const { return {jpeg_.image_width, jpeg_.image_height}; }

  [[noreturn]] void fail(const std::string& where) const {
    throw SceneError(fmt::format("the JPEG cannot be decoded ({})", error_.message.data()), where, kSaveJpegAgain);
  }

 private:
  ErrorManager error_;
  jpeg_decompress_struct jpeg_{};
};

}  // namespace

bool isJpeg(std::span<const unsigned char> bytes) { return bytes.size() >= 2 && bytes[0] == 0xFF && bytes[1] == 0xD8; }

ImageSize readJpegSize(std::span<const unsigned char> bytes, const std::string& where) {
  JpegReader reader;
  if (!reader.readHeader(bytes.data(), bytes.size())) reader.fail(where);
  return reader.size();
}

void decodeJpeg(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where) {
  JpegReader reader;
  if (!reader.readHeader(bytes.data(), bytes.size()) || !reader.read(texels.data())) reader.fail(where);
}

}  // namespace importon
