#include "loader/everything.h"

#include "loader/image_builder.h"

namespace importon::test {

GltfBuilder everything() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json& attributes = builder.primitive()["attributes"];
  attributes["NORMAL"] = builder.addPositions({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, kFloat, "VEC2");
  builder.primitive()["indices"] = builder.addIndices({0, 1, 2});
  builder.primitive()["targets"] =
      Json::array({{{"POSITION", builder.addPositions({{0, 0, 0}, {0, 0, 0}, {0, 0, 4}})}}});
  builder.json["meshes"][0]["weights"] = {0.5};
  const std::uint8_t place = 2;
  const glm::vec3 value(0, 2, 0);
  builder.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", builder.addView(&place, 1)}, {"componentType", kUnsignedByte}}},
      {"values", {{"bufferView", builder.addView(&value, sizeof value)}}}};
  Json& material = builder.json["materials"][0];
  const int png = builder.addTexture(makePng(4, 4, Bytes(64, 100)), {{"wrapS", 33071}, {"magFilter", 9729}});
  material["emissiveTexture"] = {{"index", png},
                                 {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 1}}}}}};
  material["normalTexture"] = {{"index", builder.addTexture(makeJpeg(8, 8, Bytes(192, 100)))}};
  material["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 1}, {"attenuationDistance", 2}};
  material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.5;
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}});
  builder.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"rotation", {0, 0, 0, 1}}});
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  builder.addRoot({{"camera", 0}, {"children", {3}}});
  builder.add("nodes", {{"mesh", 0}, {"scale", {-1, 2, 1}}});
  builder.json["scenes"][0]["extras"]["environment"] = {{"type", "constant"}, {"radiance", {1, 1, 1}}};
  builder.json["buffers"] = Json::array({{{"byteLength", builder.binary.size()}}});
  return builder;
}

GltfBuilder profileFile() {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const std::string lamp =
      "IES:LM-63-2019\nTILT=INCLUDE\n1 2 0 90 1 1\n1 -1 1 3 2 1 2 0 0 0 1 1 9\n0 45 90\n0 90\n9 8 1 9 7 2\n";
  builder.json["extensions"]["EXT_lights_ies"]["lights"] =
      Json::array({{{"bufferView", builder.addView(lamp.data(), lamp.size())}}});
  builder.addRoot({{"extensions", {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 0.5}}}}}});
  builder.json["buffers"] = Json::array({{{"byteLength", builder.binary.size()}}});
  return builder;
}

GltfBuilder animatedFile() {
  GltfBuilder builder = everything();
  builder.json.erase("buffers");
  const int times = builder.addAccessor(std::vector<float>{0, 1, 2}, kFloat, "SCALAR");
  const int moves = builder.addPositions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  const int spline = builder.addPositions(std::vector<glm::vec3>(9, {1, 2, 1}));
  const int turns =
      builder.addAccessor(std::vector<glm::i8vec4>{{0, 0, 0, 127}, {0, 127, 0, 0}, {127, 0, 0, 0}}, kByte, "VEC4");
  const int weights = builder.addAccessor(std::vector<float>{0, 1, 0.5f}, kFloat, "SCALAR");
  builder.json["accessors"][turns]["normalized"] = true;
  const auto channel = [](int sampler, int node, const char* path) {
    return Json{{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}};
  };
  const Json pointer{{"pointer", "/materials/0/emissiveFactor"}};
  builder.json["animations"] = Json::array(
      {{{"name", "all"},
        {"channels",
         {channel(0, 0, "translation"),
          channel(1, 3, "scale"),
          channel(2, 1, "rotation"),
          channel(3, 0, "weights"),
          {{"sampler", 1}, {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}}}}}},
        {"samplers",
         {{{"input", times}, {"output", moves}, {"interpolation", "STEP"}},
          {{"input", times}, {"output", spline}, {"interpolation", "CUBICSPLINE"}},
          {{"input", times}, {"output", turns}},
          {{"input", times}, {"output", weights}, {"interpolation", "LINEAR"}}}}}});
  builder.json["buffers"] = Json::array({{{"byteLength", builder.binary.size()}}});
  return builder;
}

}  // namespace importon::test
