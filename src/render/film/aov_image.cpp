#include "render/film/aov_image.h"

#include "render/options/aov_table.h"

namespace importon {
namespace {

void addFromBuffer(Image& image, const AovRow& row, std::span<const float> buffer, glm::dvec3 shift) {
  for (std::size_t c = 0; c < row.suffixes.size(); ++c) {
    Channel channel{std::string(row.name) + "." + row.suffixes[c], {}};
    const double offset = row.name == "P" ? shift[static_cast<int>(c)] : 0.0;
    for (std::size_t i = row.offset + c; i < buffer.size(); i += kAovFloats)
      channel.values.push_back(static_cast<float>(static_cast<double>(buffer[i]) + offset));
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

void addAovLayer(Image& image, const std::string& name, const FilmLayers& film, std::span<const float> buffer,
                 glm::dvec3 worldFromRender) {
  const AovRow& row = aovRow(name);
  switch (row.source) {
    case AovSource::buffer:
      return addFromBuffer(image, row, buffer, worldFromRender);
    case AovSource::filmDirect:
      return addColor(image, name, film.direct);
    case AovSource::filmCaustic:
      return addColor(image, name, film.caustic);
    case AovSource::filmIndirect:
      return addColor(image, name, film.indirect);
    case AovSource::filmVariance:
      return addColor(image, name, film.variance);
    case AovSource::filmError:
      return addColor(image, name, film.error);
    case AovSource::importons:
    case AovSource::photons:
      return;  // camera/aov_layers.cpp
  }
}

}  // namespace importon
