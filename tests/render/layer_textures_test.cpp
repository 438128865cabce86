// Textures of layers in the image: each reads its channels, and no others.
#include <functional>
#include <string>
#include <vector>

#include "render_helper.h"
#include "scene/packing.h"

namespace importon::test::layer_textures_test {
namespace {

class LayerTextures : public RenderTest {};

/// A texture whose channels at 0 mean the same as a factor at 0.
struct Channels {
  std::string name;
  uint Material::*texture;
  uint texel;  // 0 in the channels that count, 1 in the others; red in the low byte
  std::function<void(Material&)> withoutIt;
};

Material layered() {
  Material material = metal(vec3(0.7f, 0.6f, 0.5f), 0.4f);
  material.metallic = 0.3f;
  material.diffuseTransmission = 0.5f;
  material.diffuseTransmissionColor = vec3(0.9f, 0.5f, 0.2f);
  material.sheenColor = vec3(0.5f);
  material.sheenRoughness = 0.6f;
  material.anisotropy = 0.8f;
  material.iridescence = 0.7f;
  material.iridescenceThicknessMinimum = 200;
  material.iridescenceThicknessMaximum = 500;
  material.transmission = 0.5f;
  material.flags = kMaterialSolid;
  material.absorption = vec3(0.3f, 0.6f, 1);
  return material;
}

std::vector<Channels> channels() {
  using M = Material;
  return {{"diffuse transmission", &M::diffuseTransmissionTexture, 0x00FFFFFFu,
           [](M& m) { m.diffuseTransmission = 1e-30f; }},
          {"its colour", &M::diffuseTransmissionColorTexture, 0xFF000000u,
           [](M& m) { m.diffuseTransmissionColor = vec3(0); }},
          {"sheen", &M::sheenColorTexture, 0xFF000000u, [](M& m) { m.sheenColor = vec3(1e-30f); }},
          {"its roughness", &M::sheenRoughnessTexture, 0x00FFFFFFu, [](M& m) { m.sheenRoughness = 0; }},
          {"anisotropy", &M::anisotropyTexture, 0xFF00FFFFu, [](M& m) { m.anisotropy = 1e-30f; }},
          {"iridescence", &M::iridescenceTexture, 0xFFFFFF00u, [](M& m) { m.iridescence = 1e-30f; }},
          {"thickness of a film", &M::iridescenceThicknessTexture, 0xFFFF00FFu,
           [](M& m) { m.iridescenceThicknessMaximum = m.iridescenceThicknessMinimum; }},
          {"thickness of a volume", &M::thicknessTexture, 0xFFFF00FFu, [](M& m) { m.flags = 0; }}};
}

std::vector<float> imageOf(const Material& material, const std::vector<uint>& texels) {
  SceneBuilder builder;
  builder.square(builder.material(material), {0, 0, 0}, {0, 0.3, 1}, 2);
  builder.square(builder.material(diffuse(vec3(0.5f, 0.2f, 0.1f))), {0, 0, -1}, {0, 0, 1}, 4);
  builder.environment(vec3(1.0f));
  builder.pointLight({1, 2, 2}, vec3(5.0f));
  builder.camera({0, 0, 3}, {0, 0, 0}, 0.3, 8, 8);
  Scene scene = builder.finish();
  Texture texture{};
  texture.width = texture.height = 1;
  texture.uvRow0 = vec3(1, 0, 0);
  texture.uvRow1 = vec3(0, 1, 0);
  if (!texels.empty()) scene.textures = {texture};
  scene.texels = texels;
  for (Vertex& vertex : scene.vertices) vertex.tangent = packTangent({1, 0, 0}, false);
  RenderJob job = makeJob(Integrator::path, 1);
  job.gather = 16;
  job.forcesAllFeatures = true;  // so that all images come of the same machine code
  std::vector<float> all;
  const Rendered rendered = renderScene(job, scene);
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float> values = valuesOf(rendered.image, channel);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

/// A sheet is as thick as the texture's green says; where that is 0 it is thin, and absorbs nothing.
TEST_F(LayerTextures, TellHowThickASheetIs) {
  Material sheet = layered();
  sheet.flags = 0;
  sheet.thickness = 2;
  Material half = sheet, thin = sheet;
  half.thickness *= 0x80 / 255.0f;
  thin.thickness = 0;
  const std::vector<float> plain = imageOf(sheet, {});
  sheet.thicknessTexture = 0;
  for (const auto& [texel, same] : {std::pair{0xFFFF00FFu, thin}, std::pair{0x000080FFu, half}}) {
    const std::vector<float> found = imageOf(sheet, {texel}), expected = imageOf(same, {});
    double difference = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_NEAR(found[i], expected[i], 1e-3f * expected[i] + 1e-5f) << texel;
      difference += std::abs(static_cast<double>(found[i] - plain[i]));
    }
    EXPECT_GT(difference, 1e-3) << texel;
  }
}

TEST_F(LayerTextures, ReadTheirChannels) {
  const std::vector<float> plain = imageOf(layered(), {});
  for (const Channels& c : channels()) {
    Material textured = layered(), without = layered();
    textured.*c.texture = 0;
    c.withoutIt(without);
    const std::vector<float> found = imageOf(textured, {c.texel}), expected = imageOf(without, {});
    double difference = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_NEAR(found[i], expected[i], 1e-3f * expected[i] + 1e-5f) << c.name;
      difference += std::abs(static_cast<double>(found[i] - plain[i]));
    }
    EXPECT_GT(difference, 1e-3) << c.name << " counts for nothing";
  }
}

}  // namespace
}  // namespace importon::test::layer_textures_test
