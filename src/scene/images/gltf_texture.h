/// Uses of images by materials.
#pragma once
#include <array>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "base/log.h"
#include "scene/container/gltf_document.h"
#include "scene/materials/material_table.h"
#include "shared/scene_data.h"

namespace importon {

/// Collects textures: equal uses of an image share one entry.
class TextureTable {
 public:
  TextureTable(const GltfDocument& document, Log& log) : document_(document), log_(log) {}

  /// The index of the texture that a textureInfo at `pointer` means; kNone if `info` is null or names no image
  /// that can be read. Throws SceneError.
  [[nodiscard]] uint use(const nlohmann::json& info, const std::string& pointer, ColorMeaning meaning);

  /// firstTexel, width and height are 0.
  [[nodiscard]] const std::vector<Texture>& textures() const { return textures_; }
  /// The image, by index in the file, of each texture.
  [[nodiscard]] const std::vector<std::size_t>& images() const { return images_; }

 private:
  /// Image, sampler, colour meaning, UV set and transform.
  using Key = std::tuple<std::size_t, uint, uint, uint, uint, uint, std::array<float, 6>>;
  void readSampler(int index, Texture& texture) const;
  [[nodiscard]] uint indexOf(const Texture& texture, std::size_t image);

  const GltfDocument& document_;
  Log& log_;
  std::vector<Texture> textures_;
  std::vector<std::size_t> images_;
  std::map<Key, uint> indices_;
};

}  // namespace importon
