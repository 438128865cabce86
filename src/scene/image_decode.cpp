#include "scene/image_decode.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <memory>

#include "base/error.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>

namespace importon {
namespace {

constexpr std::size_t kLongestSide = STBI_MAX_DIMENSIONS;
constexpr std::size_t kMostTexels = std::size_t{1} << 27;
constexpr const char* kExportAgain = "save the image as PNG or JPEG again";

bool startsWith(std::span<const unsigned char> bytes, std::span<const unsigned char> head) {
  return bytes.size() >= head.size() && std::memcmp(bytes.data(), head.data(), head.size()) == 0;
}

void checkFormat(std::span<const unsigned char> bytes, const std::string& where) {
  constexpr unsigned char kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr unsigned char kJpeg[] = {0xFF, 0xD8};
  if (bytes.empty()) throw SceneError("the image is empty", where, kExportAgain);
  if (startsWith(bytes, kPng) || startsWith(bytes, kJpeg)) return;
  throw SceneError("the image is neither PNG nor JPEG", where, kExportAgain);
}

int lengthOf(std::span<const unsigned char> bytes, const std::string& where) {
  if (bytes.size() <= std::numeric_limits<int>::max()) return static_cast<int>(bytes.size());
  throw SceneError("the image file is larger than 2 GiB", where, "reduce the image");
}

[[noreturn]] void failDecoding(const std::string& where) {
  throw SceneError(fmt::format("the image cannot be decoded ({})", stbi_failure_reason()), where, kExportAgain);
}

}  // namespace

ImageSize readImageSize(std::span<const unsigned char> bytes, const std::string& where) {
  checkFormat(bytes, where);
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), lengthOf(bytes, where), &width, &height, &channels) == 0) {
    failDecoding(where);
  }
  const ImageSize size{static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
  if (size.width > kLongestSide || size.height > kLongestSide || size.texels() > kMostTexels) {
    throw SceneError(fmt::format("the image has {} x {} texels, more than {} a side or {} in all", width,
                                 height, kLongestSide, kMostTexels),
                     where, "reduce the image");
  }
  return size;
}

void decodeImage(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where) {
  int width = 0;
  int height = 0;
  int channels = 0;
  constexpr int kChannels = 4;
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(bytes.data(), lengthOf(bytes, where), &width, &height, &channels, kChannels),
      stbi_image_free);
  if (!decoded) failDecoding(where);
  if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) != texels.size()) {
    throw SceneError("the image changes its size while it is decoded", where, kExportAgain);
  }
  std::memcpy(texels.data(), decoded.get(), texels.size_bytes());
}

}  // namespace importon
