#include "render/aov_image.h"

#include <map>
#include <stdexcept>

namespace importon {
namespace {

/// Where a layer of the AOV buffer stands, and the suffixes of its channels.
struct Source {
  uint offset;
  const char* suffixes;  // one character a channel
};

const std::map<std::string, Source>& sources() {
  static const std::map<std::string, Source> table{
      {"albedo", {kAovAlbedo, "RGB"}},
      {"N", {kAovNormal, "XYZ"}},
      {"P", {kAovPosition, "XYZ"}},
      {"depth", {kAovDepth, "Z"}},
      {"emission", {kAovEmission, "RGB"}},
      {"importance.caustic", {kAovImportance, "Y"}},
      {"importance.global", {kAovImportance + 1, "Y"}},
      {"required.caustic", {kAovRequired, "Y"}},
      {"required.global", {kAovRequired + 1, "Y"}},
      {"density.caustic", {kAovDensity, "Y"}},
      {"density.global", {kAovDensity + 1, "Y"}},
      {"radiance.caustic", {kAovMapLight, "RGB"}},
      {"radiance.global", {kAovMapLight + 3, "RGB"}},
  };
  return table;
}

void addFromFloats(Image& image, const std::string& name, const Source& source, std::span<const float> floats,
                   glm::dvec3 shift) {
  for (uint c = 0; source.suffixes[c] != '\0'; ++c) {
    Channel channel{name + "." + source.suffixes[c], {}};
    const double offset = name == "P" ? shift[static_cast<int>(c)] : 0.0;
    for (std::size_t i = source.offset + c; i < floats.size(); i += kAovFloats)
      channel.values.push_back(static_cast<float>(static_cast<double>(floats[i]) + offset));
    image.channels.push_back(std::move(channel));
  }
}

}  // namespace

void addColor(Image& image, const std::string& layer, std::span<const vec3> values) {
  const char* suffixes[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    Channel channel{layer.empty() ? suffixes[c] : layer + "." + suffixes[c], {}};
    channel.values.reserve(values.size());
    for (const vec3& v : values) channel.values.push_back(v[c]);
    image.channels.push_back(std::move(channel));
  }
}

void addAovLayers(Image& image, std::span<const std::string> names, const FilmLayers& film,
                  std::span<const float> floats, glm::dvec3 worldFromRender) {
  for (const std::string& name : names) {
    if (name == "direct") addColor(image, name, film.direct);
    else if (name == "caustic") addColor(image, name, film.caustic);
    else if (name == "indirect") addColor(image, name, film.indirect);
    else if (name == "variance") addColor(image, name, film.variance);
    else if (name == "error") addColor(image, name, film.error);
    else if (const auto it = sources().find(name); it != sources().end())
      addFromFloats(image, name, it->second, floats, worldFromRender);
    else throw std::logic_error("no layer '" + name + "'");
  }
}

}  // namespace importon
