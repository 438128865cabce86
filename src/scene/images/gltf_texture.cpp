#include "scene/images/gltf_texture.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "scene/container/gltf_json.h"
#include "scene/images/image_source.h"

namespace importon {
namespace {

/// glTF 2.0, section 3.8.4.5; -1 and 0: not given.
uint wrapOf(int mode, const Faults& faults, std::size_t sampler, const char* key) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
    case -1:
      return kWrapRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return kWrapClamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return kWrapMirror;
    default:
      faults.forgive("unknown wrapping mode", fmt::format("/samplers/{}/{}", sampler, key),
                     fmt::format("wrapping mode {} is unknown", mode), "the texture repeats");
      return kWrapRepeat;
  }
}

/// A magnified texel shows as a square if the sampler says so, or names no magnification but nearest otherwise.
bool isNearest(const tinygltf::Sampler& sampler) {
  if (sampler.magFilter >= 0) return sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  return sampler.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

/// KHR_texture_transform: uv' = T R S uv, turning counter-clockwise in a plane whose v points down.
void applyTransform(const nlohmann::json& transform, Texture& texture) {
  const vec2 offset = vectorOr<2>(transform, "offset", vec2(0.0f));
  const vec2 scale = vectorOr<2>(transform, "scale", vec2(1.0f));
  const double rotation = numberOr(transform, "rotation", 0.0);
  const auto cosine = static_cast<float>(std::cos(rotation));
  const auto sine = static_cast<float>(std::sin(rotation));
  texture.uvRow0 = vec3(cosine * scale.x, sine * scale.y, offset.x);
  texture.uvRow1 = vec3(-sine * scale.x, cosine * scale.y, offset.y);
}

}  // namespace

void TextureTable::readSampler(int index, Texture& texture) const {
  if (index < 0) return;
  const auto element = static_cast<std::size_t>(index);
  const tinygltf::Sampler& sampler = document_.model.samplers[element];
  texture.wrapS = wrapOf(sampler.wrapS, document_.faults, element, "wrapS");
  texture.wrapT = wrapOf(sampler.wrapT, document_.faults, element, "wrapT");
  texture.isNearest = isNearest(sampler) ? 1u : 0u;
}

uint TextureTable::indexOf(const Texture& texture, std::size_t image) {
  const Key key{
      image,
      texture.wrapS,
      texture.wrapT,
      texture.isNearest,
      texture.isSrgb,
      texture.uvSet,
      {texture.uvRow0.x, texture.uvRow0.y, texture.uvRow0.z, texture.uvRow1.x, texture.uvRow1.y, texture.uvRow1.z}};
  const auto [entry, isNew] = indices_.emplace(key, static_cast<uint>(textures_.size()));
  if (isNew) {
    textures_.push_back(texture);
    images_.push_back(image);
  }
  return entry->second;
}

uint TextureTable::use(const nlohmann::json& info, const std::string& pointer, ColorMeaning meaning) {
  if (!info.is_object()) return kNone;
  const auto index = static_cast<std::size_t>(integerOr(info, "index", 0));
  const std::optional<std::size_t> image = chooseImage(document_, index, log_);
  if (!image) return kNone;
  Texture texture{};
  texture.isSrgb = meaning == ColorMeaning::srgb ? 1u : 0u;
  readSampler(document_.model.textures[index].sampler, texture);
  const nlohmann::json& transform = member(info, "extensions", "KHR_texture_transform");
  applyTransform(transform, texture);
  const int uvSet = integerOr(transform, "texCoord", integerOr(info, "texCoord", 0));
  texture.uvSet = uvSet == 1 ? 1u : 0u;
  if (uvSet > 1) {
    log_.warn("texture coordinates beyond the second set",
              fmt::format("{}: TEXCOORD_{} is not read; TEXCOORD_0 stands in", document_.source.at(pointer), uvSet));
  }
  return indexOf(texture, *image);
}

}  // namespace importon
