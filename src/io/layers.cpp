#include "io/layers.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "fmt/format.h"
#include "fmt/ranges.h"

namespace importon {
namespace {

std::string channelName(const std::string& layer, const char* part) {
  return layer.empty() ? part : layer + "." + part;
}

/// The channels of a layer's colour or, where it has but Y, that one three times; empty: it has neither.
std::vector<const Channel*> channelsOf(const Image& image, const std::string& layer) {
  std::vector<const Channel*> found;
  for (const char* part : {"R", "G", "B"}) found.push_back(image.find(channelName(layer, part)));
  if (std::count(found.begin(), found.end(), nullptr) == 0) return found;
  const Channel* grey = image.find(channelName(layer, "Y"));
  return grey != nullptr ? std::vector<const Channel*>(3, grey) : std::vector<const Channel*>{};
}

[[noreturn]] void refuse(const Image& image, const std::string& what, const std::string& where) {
  const std::vector<std::string> layers = colorLayers(image);
  std::vector<std::string> names;
  for (const Channel& channel : image.channels) names.push_back(channel.name);
  throw SceneError(what, where,
                   layers.empty() ? fmt::format("give an image with R, G and B; it has {}", fmt::join(names, ", "))
                                  : fmt::format("choose a layer among {}", fmt::join(layers, ", ")));
}

}  // namespace

std::vector<std::string> colorLayers(const Image& image) {
  std::vector<std::string> layers;
  for (const Channel& channel : image.channels) {
    const std::size_t dot = channel.name.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : channel.name.substr(0, dot);
    const bool hasColor = image.find(channelName(layer, "R")) != nullptr &&
                          image.find(channelName(layer, "G")) != nullptr &&
                          image.find(channelName(layer, "B")) != nullptr;
    if (hasColor && std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  }
  std::sort(layers.begin(), layers.end());
  return layers;
}

Image takeColor(const Image& image, const std::string& layer, const std::string& where) {
  const std::vector<std::string> layers = colorLayers(image);
  const bool hasOne = layers.size() == 1 && layer.empty();
  const std::vector<const Channel*> channels = channelsOf(image, hasOne ? layers.front() : layer);
  if (channels.empty()) {
    refuse(image, layer.empty() ? std::string("the image has no channels R, G, B") : fmt::format("no layer {}", layer),
           where);
  }
  Image color{image.width, image.height, {}, image.attributes, image.whole};
  constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) color.channels.push_back({kNames[c], channels[c]->values});
  return color;
}

}  // namespace importon
