/// What looks odd and is allowed: no warning, and the same scene.
#include <gtest/gtest.h>

#include <functional>

#include "loader/load.h"
#include "scene/packing.h"

namespace importon::test {
namespace {

using B = GltfBuilder;

struct Allowed {
  const char* name;
  std::function<void(B&)> change;
};

void PrintTo(const Allowed& test, std::ostream* out) { *out << test.name; }

class AllowedTest : public testing::TestWithParam<Allowed> {};

TEST_P(AllowedTest, GivesTheSameSceneWithoutAWord) {
  B builder = B::emissiveTriangle();
  const Scene plain = load(builder);
  GetParam().change(builder);
  EXPECT_EQ(warningsOf(builder).size(), 0u);
  EXPECT_EQ(errorOf(builder, kStrict), "");
  const Scene scene = load(builder);
  EXPECT_EQ(scene.positions, plain.positions);
  EXPECT_EQ(scene.lights.size(), plain.lights.size());
}

const Allowed kOdd[] = {
    {"EmptyArrays",
     [](B& b) {
       for (const char* key : {"cameras", "skins", "images", "textures", "samplers", "animations"})
         b.json[key] = Json::array();
     }},
    {"EmptyScene",
     [](B& b) {
       b.json["scenes"].push_back({{"nodes", Json::array()}});
     }},
    {"NoSceneProperty", [](B& b) { b.json.erase("scene"); }},
    {"ExtrasOfAnyKind",
     [](B& b) {
       b.json["extras"] = 1;
       b.json["nodes"][0]["extras"] = nullptr;
       b.json["meshes"][0]["extras"] = {"x", 1, nullptr};
       b.json["materials"][0]["extras"] = "text";
       b.json["accessors"][0]["extras"] = false;
       b.json["scenes"][0]["extras"] = Json::array();
     }},
    {"WholeNumbersAsFloats",
     [](B& b) {
       b.json["scene"] = 0.0;
       b.json["nodes"][0]["mesh"] = 0.0;
       b.json["accessors"][0]["count"] = 3.0;
       b.json["accessors"][0]["componentType"] = 5126.0;
       b.json["bufferViews"][0]["byteLength"] = 36.0;
       b.json["scenes"][0]["nodes"] = {0.0};
     }},
    {"EqualNames",
     [](B& b) {
       b.json["nodes"][0]["name"] = "same";
       b.json["meshes"][0]["name"] = "same";
       b.add("nodes", {{"name", "same"}});
     }},
    {"MinVersion", [](B& b) { b.json["asset"]["minVersion"] = "2.0"; }},
    {"LaterMinor", [](B& b) { b.json["asset"]["version"] = "2.7"; }},
    {"RotationOfLengthNearOne",
     [](B& b) {
       b.json["nodes"][0]["rotation"] = {0, 0, 0, 0.999};
     }},
    {"AnAnimation",
     [](B& b) {
       b.json["extensionsUsed"] = {"KHR_animation_pointer"};
       const Json target{{"path", "pointer"},
                         {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/scale"}}}}}};
       b.json["animations"] = {
           {{"channels", {{{"sampler", 0}, {"target", target}}}}, {"samplers", {{{"input", 0}, {"output", 0}}}}}};
     }},
    {"TargetNames",
     [](B& b) {
       b.json["meshes"][0]["extras"]["targetNames"] = {"one"};
       b.json["meshes"][0]["weights"] = {0};
       b.primitive()["targets"] = {{{"POSITION", 0}}};
     }},
    {"MetadataAndInteraction",
     [](B& b) {
       b.json["extensionsUsed"] = {"KHR_xmp_json_ld", "KHR_interactivity", "EXT_mesh_features", "MSFT_lod"};
     }},
    {"IndicesOfASparseAccessorWithoutAView",
     [](B& b) {
       const std::uint8_t places[4] = {1, 2, 0, 0};
       const int indices = b.addView(places, 2), values = b.addView(places, 2);
       const Json byte{{"bufferView", indices}, {"componentType", kUnsignedByte}};
       b.primitive()["indices"] =
           b.add("accessors", {{"componentType", kUnsignedByte},
                               {"count", 3},
                               {"type", "SCALAR"},
                               {"sparse", {{"count", 2}, {"indices", byte}, {"values", {{"bufferView", values}}}}}});
     }},
};
INSTANTIATE_TEST_SUITE_P(Odd, AllowedTest, testing::ValuesIn(kOdd),
                         [](const auto& instance) { return instance.param.name; });

TEST(Allowed, NormalsOfAnyLengthAndOfNone) {
  B builder = B::emissiveTriangle();
  builder.primitive()["attributes"]["NORMAL"] = builder.addPositions({{0, 0, 7}, {0, 0, 1e-3f}, {0, 0, 0}});
  EXPECT_EQ(warningsOf(builder).size(), 0u);
  const Scene scene = load(builder);
  EXPECT_EQ(unpackNormal(scene.vertices[0].normal), vec3(0, 0, 1));
  EXPECT_EQ(unpackNormal(scene.vertices[1].normal), vec3(0, 0, 1));
  EXPECT_EQ(scene.vertices[2].normal, kNone);
}

TEST(Allowed, StridesThatAreNoMultipleOfFourOrAbove252) {
  for (const std::size_t stride : {std::size_t{14}, std::size_t{300}}) {
    B builder = B::emissiveTriangle();
    Bytes spread(2 * stride + 12);
    for (std::size_t i = 0; i < 3; ++i) std::memcpy(spread.data() + i * stride, builder.binary.data() + 12 * i, 12);
    const int view = builder.addView(spread.data(), spread.size());
    builder.json["bufferViews"][view]["byteStride"] = stride;
    builder.json["accessors"][0]["bufferView"] = view;
    EXPECT_EQ(load(builder).positions, load(B::emissiveTriangle()).positions) << stride;
  }
}

TEST(Allowed, AStrideOfZeroIsNone) {
  B builder = B::emissiveTriangle();
  builder.json["bufferViews"][0]["byteStride"] = 0;
  EXPECT_EQ(load(builder).positions, load(B::emissiveTriangle()).positions);
}

}  // namespace
}  // namespace importon::test
