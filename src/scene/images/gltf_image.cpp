#include "scene/images/gltf_image.h"

#include <fmt/format.h>

#include <exception>
#include <iterator>
#include <set>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/images/image_decode.h"

namespace importon {
namespace {

/// An image and its place among the texels.
struct ImageUse {
  std::span<const unsigned char> bytes;
  std::string where;
  ImageSize size;
  std::size_t firstTexel = 0;
};

/// Decodes all; of several errors the first in the file is thrown, whatever the threads do.
void decodeAll(const std::vector<ImageUse>& images, std::vector<uint>& texels) {
  std::vector<std::exception_ptr> errors(images.size());
  parallelFor(images.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      try {
        const ImageUse& image = images[i];
        decodeImage(image.bytes, std::span(texels).subspan(image.firstTexel, image.size.texels()), image.where);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  });
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

/// The images that textures use, in the order of the file, one after another among the texels.
std::vector<ImageUse> placeImages(const GltfDocument& document, const std::set<std::size_t>& indices) {
  constexpr std::size_t kMostTexels = std::size_t{1} << 28;
  std::vector<ImageUse> images;
  std::size_t texelCount = 0;
  for (const std::size_t index : indices) {
    ImageUse image{encodedImage(document.model, index), document.source.at(fmt::format("/images/{}", index)), {}, 0};
    image.size = readImageSize(image.bytes, image.where);
    image.firstTexel = texelCount;
    texelCount += image.size.texels();
    if (texelCount > kMostTexels) {
      throw SceneError(fmt::format("the images have more than {} texels in all", kMostTexels), image.where,
                       "reduce the images");
    }
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace

std::span<const unsigned char> encodedImage(const tinygltf::Model& model, std::size_t image) {
  const tinygltf::Image& source = model.images[image];
  if (source.bufferView < 0) return source.image;
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(source.bufferView)];
  const std::vector<unsigned char>& buffer = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  return std::span(buffer).subspan(view.byteOffset, view.byteLength);
}

std::vector<uint> loadTexels(const GltfDocument& document, MaterialSet& set) {
  const std::set<std::size_t> indices(set.imageOfTexture.begin(), set.imageOfTexture.end());
  const std::vector<ImageUse> images = placeImages(document, indices);
  std::vector<uint> texels(images.empty() ? 0 : images.back().firstTexel + images.back().size.texels());
  decodeAll(images, texels);
  for (std::size_t t = 0; t < set.textures.size(); ++t) {
    const auto place = std::distance(indices.begin(), indices.find(set.imageOfTexture[t]));
    const ImageUse& image = images[static_cast<std::size_t>(place)];
    set.textures[t].firstTexel = static_cast<uint>(image.firstTexel);
    set.textures[t].width = static_cast<uint>(image.size.width);
    set.textures[t].height = static_cast<uint>(image.size.height);
  }
  return texels;
}

}  // namespace importon
