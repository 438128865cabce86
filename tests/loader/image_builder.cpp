#include "loader/image_builder.h"

#include <avif/avif.h>
#include <webp/encode.h>

#include <cstdlib>

// jpeglib.h needs FILE.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
// clang-format on

namespace importon::test {
namespace {

void appendBigEndian(Bytes& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<unsigned char>(word >> shift & 0xFFu));
}

/// ISO 3309, as PNG asks for.
std::uint32_t crc32(std::span<const unsigned char> bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const unsigned char byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return ~crc;
}

void appendChunk(Bytes& png, const char* type, const Bytes& payload) {
  appendBigEndian(png, static_cast<std::uint32_t>(payload.size()));
  Bytes body(type, type + 4);
  body.insert(body.end(), payload.begin(), payload.end());
  png.insert(png.end(), body.begin(), body.end());
  appendBigEndian(png, crc32(body));
}

/// zlib with stored blocks [RFC 1950, RFC 1951].
Bytes deflateStored(const Bytes& data) {
  Bytes zlib = {0x78, 0x01};
  constexpr std::size_t kLongestBlock = 65535;
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (std::size_t first = 0; first == 0 || first < data.size(); first += kLongestBlock) {
    const std::size_t length = std::min(kLongestBlock, data.size() - first);
    zlib.push_back(first + length == data.size() ? 1 : 0);
    for (const std::size_t value : {length, ~length}) {
      zlib.push_back(static_cast<unsigned char>(value & 0xFFu));
      zlib.push_back(static_cast<unsigned char>(value >> 8 & 0xFFu));
    }
    for (std::size_t i = first; i < first + length; ++i) {
      zlib.push_back(data[i]);
      a = (a + data[i]) % 65521u;
      b = (b + a) % 65521u;
    }
  }
  appendBigEndian(zlib, b << 16 | a);
  return zlib;
}

Bytes pngHead(const PngHeader& header, bool isInterlaced) {
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  Bytes head;
  appendBigEndian(head, header.width);
  appendBigEndian(head, header.height);
  head.insert(head.end(), {header.bitDepth, header.colorType, 0, 0, static_cast<unsigned char>(isInterlaced ? 1 : 0)});
  appendChunk(png, "IHDR", head);
  return png;
}

}  // namespace

Bytes makePng(const PngHeader& header, const Bytes& samples) {
  Bytes png = pngHead(header, false);
  if (!header.palette.empty()) appendChunk(png, "PLTE", header.palette);
  if (!header.transparency.empty()) appendChunk(png, "tRNS", header.transparency);
  const std::size_t rowBytes = samples.size() / header.height;
  Bytes rows;
  for (std::size_t row = 0; row * rowBytes < samples.size(); ++row) {
    rows.push_back(0);
    const auto first = samples.begin() + static_cast<std::ptrdiff_t>(row * rowBytes);
    rows.insert(rows.end(), first, first + static_cast<std::ptrdiff_t>(rowBytes));
  }
  appendChunk(png, "IDAT", deflateStored(rows));
  appendChunk(png, "IEND", {});
  return png;
}

Bytes makeInterlacedPng(std::uint32_t width, std::uint32_t height, const Bytes& grey) {
  struct Pass {
    unsigned x, y, stepX, stepY;
  };
  constexpr Pass kAdam7[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                             {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};  // PNG, section 8.2
  Bytes rows;
  for (const Pass& pass : kAdam7) {
    if (pass.x >= width) continue;
    for (unsigned y = pass.y; y < height; y += pass.stepY) {
      rows.push_back(0);
      for (unsigned x = pass.x; x < width; x += pass.stepX) rows.push_back(grey[y * width + x]);
    }
  }
  Bytes png = pngHead({.width = width, .height = height, .colorType = 0}, true);
  appendChunk(png, "IDAT", deflateStored(rows));
  appendChunk(png, "IEND", {});
  return png;
}

Bytes makePng(std::uint32_t width, std::uint32_t height, const Bytes& rgba) {
  return makePng({.width = width, .height = height}, rgba);
}

Bytes makeJpeg(unsigned width, unsigned height, const Bytes& samples, JpegKind kind) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr error{};
  jpeg.err = jpeg_std_error(&error);
  jpeg_create_compress(&jpeg);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &data, &size);
  jpeg.image_width = width;
  jpeg.image_height = height;
  const bool hasInks = kind == JpegKind::inks || kind == JpegKind::adobeInks;
  jpeg.input_components = hasInks ? 4 : kind == JpegKind::grey ? 1 : 3;
  jpeg.in_color_space = hasInks ? JCS_CMYK : kind == JpegKind::grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  if (kind == JpegKind::adobeInks) jpeg_set_colorspace(&jpeg, JCS_YCCK);
  if (kind == JpegKind::inks) jpeg.write_Adobe_marker = FALSE;
  if (kind == JpegKind::progressive) jpeg_simple_progression(&jpeg);
  if (kind == JpegKind::arithmetic) jpeg.arith_code = TRUE;
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  for (std::size_t row = 0; row < height; ++row) {
    JSAMPROW line = const_cast<JSAMPROW>(&samples[row * width * static_cast<unsigned>(jpeg.input_components)]);
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  Bytes bytes(data, data + size);
  std::free(data);
  return bytes;
}

Bytes makeWebp(int width, int height, const Bytes& rgba, bool isLossless) {
  std::uint8_t* data = nullptr;
  const std::size_t size = isLossless ? WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &data)
                                      : WebPEncodeRGBA(rgba.data(), width, height, 4 * width, 100, &data);
  Bytes bytes(data, data + size);
  WebPFree(data);
  return bytes;
}

Bytes makeAvif(std::uint32_t side, std::array<unsigned, 4> rgba, std::uint32_t bits) {
  avifImage* image =
      avifImageCreate(static_cast<int>(side), static_cast<int>(side), static_cast<int>(bits), AVIF_PIXEL_FORMAT_YUV444);
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_IDENTITY;
  avifRGBImage rgb;
  avifRGBImageSetDefaults(&rgb, image);
  std::vector<std::uint16_t> wide;
  Bytes narrow;
  for (std::uint32_t i = 0; i < 4 * side * side; ++i) {
    wide.push_back(static_cast<std::uint16_t>(rgba[i % 4]));
    narrow.push_back(static_cast<unsigned char>(rgba[i % 4]));
  }
  rgb.pixels = bits > 8 ? reinterpret_cast<std::uint8_t*>(wide.data()) : narrow.data();
  rgb.rowBytes = side * (bits > 8 ? 8 : 4);
  avifImageRGBToYUV(image, &rgb);
  avifEncoder* encoder = avifEncoderCreate();
  encoder->minQuantizer = encoder->maxQuantizer = AVIF_QUANTIZER_LOSSLESS;
  encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = AVIF_QUANTIZER_LOSSLESS;
  encoder->speed = AVIF_SPEED_FASTEST;
  avifRWData output = AVIF_DATA_EMPTY;
  const bool isEncoded = avifEncoderWrite(encoder, image, &output) == AVIF_RESULT_OK;
  Bytes bytes;
  if (isEncoded) bytes.assign(output.data, output.data + output.size);
  avifRWDataFree(&output);
  avifEncoderDestroy(encoder);
  avifImageDestroy(image);
  return bytes;
}

}  // namespace importon::test
