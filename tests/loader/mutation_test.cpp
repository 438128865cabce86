/// Files with random damage: whatever comes, loading ends with a scene or a SceneError.
#include <gtest/gtest.h>

#include <random>

#include "loader/image_builder.h"
#include "loader/load.h"

namespace importon::test {
namespace {

/// A small file that uses as much of the format as it can.
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
  material["emissiveTexture"] = {
      {"index", png}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 1}}}}}};
  material["normalTexture"] = {{"index", builder.addTexture(makeJpeg(8, 8, Bytes(192, 100)))}};
  material["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 1}, {"attenuationDistance", 2}};
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

/// Flips, overwrites, removes, repeats or cuts a few bytes.
Bytes damaged(Bytes bytes, std::mt19937& random) {
  const auto below = [&](std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
  };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    const auto position = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(12)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(position);
        break;
      case 2:
        bytes.insert(position, bytes[at]);
        break;
      case 3:
        bytes[at] = static_cast<unsigned char>(below(256));
        break;
      case 4:
        bytes[at] = 0xFF;
        break;
      case 5:
      case 6:
      case 7:
        bytes[at] = static_cast<unsigned char>('0' + below(10));
        break;
      default:
        bytes[at] = static_cast<unsigned char>(bytes[at] ^ 1u << below(8));
        break;
    }
  }
  return bytes;
}

/// How many of `count` damaged copies still load.
int loaded(const Bytes& whole, unsigned seed, int count) {
  std::mt19937 random(seed);
  int scenes = 0;
  testing::internal::CaptureStderr();
  for (int i = 0; i < count; ++i) {
    const Bytes bytes = damaged(whole, random);
    Log log(Log::Verbosity::quiet);
    try {
      scenes += load(bytes, log).triangles.empty() ? 0 : 1;
    } catch (const SceneError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  testing::internal::GetCapturedStderr();
  return scenes;
}

constexpr int kCopies = 2000;

TEST(Mutation, TheWholeFileLoads) { EXPECT_EQ(errorOf(everything()), ""); }

TEST(Mutation, DamagedGlbNeverCrashes) {
  const int scenes = loaded(everything().glb(), 1, kCopies);
  EXPECT_GT(scenes, 0) << "the damage is too heavy to test anything";
  EXPECT_LT(scenes, kCopies) << "the damage is too light to test anything";
}

TEST(Mutation, DamagedGltfNeverCrashes) {
  const int scenes = loaded(everything().gltf(), 2, kCopies);
  EXPECT_GT(scenes, 0);
  EXPECT_LT(scenes, kCopies);
}

TEST(Mutation, DamagedDataNeverCrashes) {
  const GltfBuilder builder = everything();
  std::mt19937 random(3);
  testing::internal::CaptureStderr();
  for (int i = 0; i < kCopies; ++i) {
    GltfBuilder copy = builder;
    copy.binary = damaged(copy.binary, random);
    copy.binary.resize(builder.binary.size());
    (void)errorOf(copy);
  }
  testing::internal::GetCapturedStderr();
}

/// All members and elements of a document, by JSON pointer.
void collect(const Json& value, const Json::json_pointer& place, std::vector<Json::json_pointer>& places) {
  places.push_back(place);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) collect(member, place / key, places);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], place / i, places);
  }
}

TEST(Mutation, NoMemberOfTheWrongKindCrashes) {
  const GltfBuilder builder = everything();
  std::vector<Json::json_pointer> places;
  collect(builder.json, Json::json_pointer(), places);
  const Json kinds[] = {nullptr,
                        true,
                        -1,
                        0,
                        2,
                        2147483648,
                        18446744073709551615u,
                        1e300,
                        -0.5,
                        "",
                        "text",
                        Json::array(),
                        Json::object(),
                        Json::array({0, 0}),
                        Json::array({nullptr})};
  testing::internal::CaptureStderr();
  for (const Json::json_pointer& place : places) {
    for (const Json& kind : kinds) {
      GltfBuilder copy = builder;
      copy.json[place] = kind;
      (void)errorOf(copy);
    }
  }
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace importon::test
