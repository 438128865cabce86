#include "scene/nodes/gltf_image_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "base/error.h"
#include "scene/container/gltf_json.h"
#include "scene/environment.h"
#include "scene/images/image_decode.h"
#include "scene/images/image_source.h"
#include "scene/light_math.h"
#include "scene/nodes/gltf_nodes.h"

namespace importon {
namespace {

using glm::dvec3;
/// The second is a draft: it has the same lights, but their pictures are cubes in KTX2 files, which are not read.
constexpr const char *kName = "EXT_lights_image_based", *kDraft = "KHR_lights_environment";
constexpr std::size_t kLargestFace = 2048;

/// A face of the cube as it is seen from inside.
struct Face {
  dvec3 forward, right, down;
};
const std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                     {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                     {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                     {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                     {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
                                     {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}}};

double linearOf(uint byte) {
  const double value = byte / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// RGBD where the picture has alpha: colour over alpha.
std::vector<dvec3> radianceOf(const std::vector<uint>& texels) {
  std::vector<dvec3> radiance;
  radiance.reserve(texels.size());
  for (const uint texel : texels) {
    const double divisor = std::max(texel >> 24, 1u) / 255.0;
    radiance.push_back(dvec3(linearOf(texel & 255u), linearOf((texel >> 8) & 255u), linearOf((texel >> 16) & 255u)) /
                       divisor);
  }
  return radiance;
}

class Cube {
 public:
  Cube(const GltfDocument& document, const nlohmann::json& images, const std::string& where, Log& log) {
    for (std::size_t face = 0; face < kFaces.size(); ++face) {
      const auto index = static_cast<std::size_t>(integerOr(nlohmann::json{{"index", images[face]}}, "index", 0));
      const EncodedImage encoded = readEncodedImage(document, index, log);
      const std::span<const unsigned char> bytes = encoded.bytes();
      const std::string place = document.source.at(fmt::format("/images/{}", index));
      const ImageSize size = readImageSize(bytes, place);
      if (face == 0) side_ = size.width;
      if (size.width != side_ || size.height != side_ || side_ > kLargestFace)
        throw SceneError(fmt::format("the faces of the cube are not all squares of one size up to {}", kLargestFace),
                         where, "export the pictures again");
      std::vector<uint> texels(size.texels());
      decodeImage(bytes, texels, place);
      faces_[face] = radianceOf(texels);
    }
  }

  [[nodiscard]] std::size_t side() const { return side_; }

  /// The texel in that direction.
  [[nodiscard]] dvec3 at(const dvec3& direction) const {
    const dvec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto face = static_cast<std::size_t>(2 * axis + (direction[axis] < 0 ? 1 : 0));
    const dvec3 onFace = direction / size[axis];
    const auto place = [&](const dvec3& along) {
      const double texel = (0.5 + 0.5 * glm::dot(onFace, along)) * static_cast<double>(side_);
      return static_cast<std::size_t>(std::clamp(texel, 0.0, static_cast<double>(side_) - 1));
    };
    return faces_[face][place(kFaces[face].down) * side_ + place(kFaces[face].right)];
  }

 private:
  std::size_t side_ = 0;
  std::array<std::vector<dvec3>, 6> faces_;
};

/// Radiance whose irradiance has these nine coefficients. [Ramamoorthi and Hanrahan 2001, eq. 3 and 8]
dvec3 radianceOfHarmonics(const std::array<dvec3, 9>& irradiance, const dvec3& n) {
  const std::array<double, 9> basis = {0.282095,
                                       0.488603 * n.y,
                                       0.488603 * n.z,
                                       0.488603 * n.x,
                                       1.092548 * n.x * n.y,
                                       1.092548 * n.y * n.z,
                                       0.315392 * (3 * n.z * n.z - 1),
                                       1.092548 * n.x * n.z,
                                       0.546274 * (n.x * n.x - n.y * n.y)};
  dvec3 sum(0.0);
  for (std::size_t i = 0; i < basis.size(); ++i)
    sum += irradiance[i] * (basis[i] / (i == 0 ? kPi : i < 4 ? 2 * kPi / 3 : kPi / 4));
  return glm::max(sum, dvec3(0.0));
}

glm::dquat rotationOf(const nlohmann::json& light, const std::string& where) {
  const vec4 q = vectorOr<4>(light, "rotation", vec4(0, 0, 0, 1));
  const double length = glm::length(glm::dvec4(q));
  if (!(length > 0) || !std::isfinite(length))
    throw SceneError("the rotation is not a unit quaternion", where, "correct the file or export it again");
  return glm::dquat(q.w, q.x, q.y, q.z) / length;
}

/// The light that the scene uses: the extension's name and the light's index, -1 for none.
struct LightUse {
  const char* extension = kName;
  int index = -1;
};

LightUse lightUsed(const GltfDocument& document) {
  const nlohmann::json& scene = element(member(document.json, "scenes"), defaultScene(document));
  if (const int own = integerOr(member(scene, "extensions", kName), "light", -1); own >= 0) return {kName, own};
  const nlohmann::json& draft = member(scene, "extensions", kDraft);
  return {kDraft, integerOr(draft, "environment", integerOr(draft, "light", -1))};
}

/// The nine coefficients, W/m²; none where there are not as many.
std::optional<std::array<dvec3, 9>> coefficientsOf(const nlohmann::json& light) {
  const nlohmann::json& values = member(light, "irradianceCoefficients");
  std::array<dvec3, 9> coefficients{};
  if (!values.is_array() || values.size() != coefficients.size()) return std::nullopt;
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    for (int c = 0; c < 3; ++c) coefficients[i][c] = values[i][static_cast<std::size_t>(c)].get<double>();
  return coefficients;
}

}  // namespace

std::optional<EnvironmentMap> readImageLight(const GltfDocument& document, Log& log) {
  const auto [extension, index] = lightUsed(document);
  if (index < 0) return std::nullopt;
  const std::string where = document.source.at(fmt::format("/extensions/{}/lights/{}", extension, index));
  const nlohmann::json& light =
      element(member(document.json, "extensions", extension, "lights"), static_cast<std::size_t>(index));
  const glm::dquat back = glm::inverse(rotationOf(light, where));
  const double intensity = numberOr(light, "intensity", 1.0);
  const nlohmann::json& images = element(member(light, "specularImages"), 0);
  if (images.is_array() && images.size() == kFaces.size()) {
    const Cube cube(document, images, where, log);
    return mapOf(
        static_cast<int>(2 * cube.side()), [&](const dvec3& d) { return cube.at(back * d); }, intensity);
  }
  const std::optional<std::array<dvec3, 9>> coefficients = coefficientsOf(light);
  if (!coefficients && extension == kDraft) {
    log.warn("image-based light that is not read", fmt::format("{}: cubes in KTX2 files are passed over", where));
    return std::nullopt;
  }
  if (!coefficients)
    throw SceneError("the light has neither six specularImages nor nine irradianceCoefficients", where,
                     "export the light again");
  log.warn("image-based light without pictures",
           fmt::format("{}: no cube of pictures: the light is as soft as its irradianceCoefficients", where));
  constexpr int kHeight = 64;
  return mapOf(
      kHeight, [&](const dvec3& d) { return radianceOfHarmonics(*coefficients, back * d); }, intensity);
}

}  // namespace importon
