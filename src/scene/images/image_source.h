/// Which image a texture shows, and its bytes.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/log.h"
#include "scene/container/gltf_document.h"

namespace importon {

/// An image as it stands in the file, not decoded.
class EncodedImage {
 public:
  explicit EncodedImage(std::span<const unsigned char> view) : bytes_(view) {}
  explicit EncodedImage(std::vector<unsigned char> own) : own_(std::move(own)), bytes_(own_) {}
  EncodedImage(EncodedImage&&) = default;
  EncodedImage& operator=(EncodedImage&&) = default;
  EncodedImage(const EncodedImage&) = delete;
  EncodedImage& operator=(const EncodedImage&) = delete;
  ~EncodedImage() = default;

  [[nodiscard]] std::span<const unsigned char> bytes() const { return bytes_; }

 private:
  std::vector<unsigned char> own_;
  std::span<const unsigned char> bytes_;  // stays where own_ is moved
};

/// The image of a texture: its own `source` or, where that is missing, that of EXT_texture_avif, EXT_texture_webp or
/// KHR_texture_basisu. Empty, with a warning, where it has none whose file is there: the material's factor stands
/// alone. Throws SceneError.
[[nodiscard]] std::optional<std::size_t> chooseImage(const GltfDocument& document, std::size_t texture, Log& log);

/// The bytes of an image: a buffer view, a data URI or a file. Throws SceneError.
[[nodiscard]] EncodedImage readEncodedImage(const GltfDocument& document, std::size_t image, Log& log);

}  // namespace importon
