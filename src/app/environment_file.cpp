#include "app/environment_file.h"

#include <array>

#include "base/error.h"
#include "io/image.h"
#include "scene/environment.h"

namespace importon {

std::optional<EnvironmentMap> readEnvironmentFile(const std::filesystem::path& file) {
  if (file.empty()) return std::nullopt;
  const Image image = isHdr(file) ? readHdr(file) : readExr(file);
  std::array<const Channel*, 3> channels{image.find("R"), image.find("G"), image.find("B")};
  if (const Channel* grey = image.find("Y"); grey != nullptr && channels[0] == nullptr) channels.fill(grey);
  EnvironmentMap map{image.width, image.height,
                     std::vector<vec3>(channels[0] == nullptr ? 0 : channels[0]->values.size())};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c] == nullptr)
      throw SceneError("the environment map has no channels R, G and B", file.string(), "give an RGB image");
    for (std::size_t i = 0; i < map.texels.size(); ++i) map.texels[i][static_cast<int>(c)] = channels[c]->values[i];
  }
  checkEnvironment(map, file.string());
  return map;
}

}  // namespace importon
