#include "scene/images/gltf_image.h"

#include <fmt/format.h>

#include <exception>
#include <map>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/images/image_decode.h"
#include "scene/images/image_source.h"
#include "scene/scene.h"

namespace importon {
namespace {

/// An image and its place among the texels, in words.
struct ImageUse {
  EncodedImage encoded;
  std::string where;
  ImageSize size;
  TexelDepth depth = TexelDepth::eight;
  std::size_t firstWord = 0;
  [[nodiscard]] std::size_t words() const { return size.texels() * (depth == TexelDepth::eight ? 1 : 2); }
};

/// Decodes all; of several errors the first in the file is thrown, whatever the threads do.
void decodeAll(const std::map<std::size_t, ImageUse>& placed, std::vector<uint>& texels) {
  std::vector<const ImageUse*> images;
  for (const auto& [index, image] : placed) images.push_back(&image);
  std::vector<std::exception_ptr> errors(images.size());
  parallelFor(images.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      try {
        const ImageUse& image = *images[i];
        decodeImage(image.encoded.bytes(), std::span(texels).subspan(image.firstWord, image.words()), image.where,
                    image.depth);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  });
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

/// By image in the file: whether what a texture reads there is a quantity and no colour, of which eyes want 8 bits.
std::map<std::size_t, bool> usedImages(const MaterialSet& set) {
  std::map<std::size_t, bool> isQuantity;
  for (std::size_t t = 0; t < set.textures.size(); ++t) {
    bool& value = isQuantity.try_emplace(set.imageOfTexture[t], false).first->second;
    value = value || set.textures[t].isSrgb == 0;
  }
  return isQuantity;
}

/// The images that textures use, by index in the file, one after another among the texels.
std::map<std::size_t, ImageUse> placeImages(const GltfDocument& document, const MaterialSet& set, Log& log) {
  std::map<std::size_t, ImageUse> images;
  std::size_t wordCount = 0;
  for (const auto& [index, isQuantity] : usedImages(set)) {
    ImageUse image{readEncodedImage(document, index, log), document.source.at(fmt::format("/images/{}", index)), {}};
    image.size = readImageSize(image.encoded.bytes(), image.where);
    if (image.size.isDeep && isQuantity) image.depth = TexelDepth::sixteen;
    image.firstWord = wordCount;
    wordCount += image.words();
    if (wordCount > kMostTexels) {
      throw SceneError(fmt::format("the images have more than {} texels in all", kMostTexels), image.where,
                       "reduce the images");
    }
    images.emplace(index, std::move(image));
  }
  return images;
}

}  // namespace

std::vector<uint> loadTexels(const GltfDocument& document, MaterialSet& set, Log& log) {
  const std::map<std::size_t, ImageUse> images = placeImages(document, set, log);
  std::vector<uint> texels(images.empty() ? 0 : images.rbegin()->second.firstWord + images.rbegin()->second.words());
  decodeAll(images, texels);
  for (std::size_t t = 0; t < set.textures.size(); ++t) {
    const ImageUse& image = images.at(set.imageOfTexture[t]);
    set.textures[t].firstTexel = static_cast<uint>(image.firstWord);
    set.textures[t].width = static_cast<uint>(image.size.width);
    set.textures[t].height = static_cast<uint>(image.size.height);
    set.textures[t].isDeep = image.depth == TexelDepth::sixteen ? 1u : 0u;
  }
  return texels;
}

}  // namespace importon
