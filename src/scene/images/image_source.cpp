#include "scene/images/image_source.h"

#include <fmt/format.h>

#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_resources.h"
#include "scene/container/gltf_view.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// Throws MissingFileError where there is nothing to read.
void checkThere(const GltfDocument& document, std::size_t index) {
  const Json& image = element(member(document.json, "images"), index);
  const std::string where = fmt::format("/images/{}", index);
  const std::string uri = stringOr(image, "uri", "");
  const bool hasView = image.contains("bufferView");
  if (image.contains("uri") && hasView) {
    throw SceneError("an image needs either 'uri' or 'bufferView'", document.source.at(where), kExportAgain);
  }
  if (!image.contains("uri") && !hasView) {
    throw MissingFileError("the image has neither 'uri' nor 'bufferView'", document.source.at(where), kExportAgain);
  }
  if (!hasView && !isDataUri(uri)) (void)locateFile(uri, document.folder, document.source.at(where + "/uri"));
}

/// The images that may show as the texture, the best first.
std::vector<std::size_t> candidates(const Json& texture) {
  std::vector<std::size_t> images;
  const auto add = [&](const Json& owner) {
    const int image = integerOr(owner, "source", -1);
    if (image >= 0) images.push_back(static_cast<std::size_t>(image));
  };
  add(texture);
  for (const char* name : {"EXT_texture_avif", "EXT_texture_webp", "KHR_texture_basisu"}) {
    add(member(texture, "extensions", name));
  }
  return images;
}

}  // namespace

std::optional<std::size_t> chooseImage(const GltfDocument& document, std::size_t texture, Log& log) {
  std::string reason, pointer;
  for (const std::size_t image : candidates(element(member(document.json, "textures"), texture))) {
    try {
      checkThere(document, image);
      return image;
    } catch (const MissingFileError& error) {
      if (!reason.empty()) continue;
      reason = error.problem();
      const bool hasUri = element(member(document.json, "images"), image).contains("uri");
      pointer = fmt::format("/images/{}{}", image, hasUri ? "/uri" : "");
    }
  }
  if (reason.empty()) {
    log.warn("texture without image", fmt::format("{}: the texture names no image that can be read and is passed over",
                                                  document.source.at(fmt::format("/textures/{}", texture))));
  } else {
    document.faults.forgive("missing image", pointer, reason, "the material's factor stands alone");
  }
  return std::nullopt;
}

EncodedImage readEncodedImage(const GltfDocument& document, std::size_t index, Log& log) {
  checkThere(document, index);
  const Json& image = element(member(document.json, "images"), index);
  const int view = integerOr(image, "bufferView", -1);
  if (view >= 0) return EncodedImage(viewBytes(document, static_cast<std::size_t>(view)));
  const std::string where = document.source.at(fmt::format("/images/{}/uri", index));
  return EncodedImage(readUri(image["uri"].get_ref<const std::string&>(), document.folder, where, log));
}

}  // namespace importon
