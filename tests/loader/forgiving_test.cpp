/// A table of small faults: each gives one warning and a scene, and is refused where the file is read strictly.
#include <gtest/gtest.h>

#include <functional>

#include "loader/load.h"

namespace importon::test {
namespace {

using B = GltfBuilder;

struct SmallFault {
  const char* name;
  std::function<void(B&)> spoil;
  const char* kind;              // of the warning
  const char* message;           // a part of the error where it is refused
  const char* pointer;           // of the error, after "test.glb#"
  const char* warned = nullptr;  // the pointer of the warning, where it is another
};

void PrintTo(const SmallFault& test, std::ostream* out) { *out << test.name; }

class ForgivingTest : public testing::TestWithParam<SmallFault> {};

/// Two triangles in meshes of their own, so that one is left.
B twoTriangles() {
  B builder = B::emissiveTriangle();
  builder.addMesh(
      {{"attributes", {{"POSITION", builder.addPositions({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}})}}}, {"material", 0}});
  return builder;
}

TEST_P(ForgivingTest, WarnsOnceAndLoads) {
  B builder = twoTriangles();
  GetParam().spoil(builder);
  const std::vector<Warning> warnings = warningsOf(builder);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, GetParam().kind);
  const std::string pointer = GetParam().warned != nullptr ? GetParam().warned : GetParam().pointer;
  EXPECT_EQ(warnings[0].message.find("test.glb#" + pointer + ": "), 0u) << warnings[0].message;
}

TEST(Forgiving, NodesThatASceneListsAreDrawnOnce) {
  B below = twoTriangles();
  below.json["nodes"][1]["children"] = {0};
  EXPECT_EQ(load(below).triangles.size(), 2u);
  B twice = twoTriangles();
  twice.json["scenes"][0]["nodes"] = {0, 1, 1, 0};
  EXPECT_EQ(load(twice).triangles.size(), 2u);
  B outside = twoTriangles();
  outside.add("nodes", {{"children", {0}}, {"translation", {9, 0, 0}}});
  const Scene scene = load(outside);
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.positions[0], vec3(0));
}

TEST_P(ForgivingTest, RefusesWhereItReadsStrictly) {
  B builder = twoTriangles();
  GetParam().spoil(builder);
  const std::string error = errorOf(builder, kStrict);
  EXPECT_NE(error.find(GetParam().message), std::string::npos) << error;
  EXPECT_NE(error.find(std::string("(test.glb#") + GetParam().pointer + "):"), std::string::npos) << error;
}

constexpr const char* kRange = "number off its range";
constexpr const char* kSkipped = "primitive without vertices";

Json& material(B& b) { return b.json["materials"][0]; }

/// KHR_lights_punctual with one light, and a node that has it.
void addLight(B& b, const Json& light) {
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  b.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

const SmallFault kNumbers[] = {
    {"AlphaAboveOneByRounding",
     [](B& b) {
       material(b)["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1.00016};
     },
     kRange, "1.00016 lies outside 0 to 1", "/materials/0/pbrMetallicRoughness/baseColorFactor/3"},
    {"BaseColorFarAboveOne",
     [](B& b) {
       material(b)["pbrMetallicRoughness"]["baseColorFactor"] = {1.5, 1, 1, 1};
     },
     kRange, "1.5 lies outside", "/materials/0/pbrMetallicRoughness/baseColorFactor/0"},
    {"MetallicBelowZeroByRounding", [](B& b) { material(b)["pbrMetallicRoughness"]["metallicFactor"] = -1e-9; }, kRange,
     "-1e-09 lies outside", "/materials/0/pbrMetallicRoughness/metallicFactor"},
    {"RoughnessAboveOne", [](B& b) { material(b)["pbrMetallicRoughness"]["roughnessFactor"] = 2; }, kRange,
     "2 lies outside 0 to 1", "/materials/0/pbrMetallicRoughness/roughnessFactor"},
    {"NegativeEmission",
     [](B& b) {
       material(b)["emissiveFactor"] = {1, -2, 3};
     },
     kRange, "-2 lies outside", "/materials/0/emissiveFactor/1"},
    {"IorBelowOne", [](B& b) { material(b)["extensions"]["KHR_materials_ior"]["ior"] = 0.5; }, kRange,
     "ior 0.5 is less than 1", "/materials/0/extensions/KHR_materials_ior/ior"},
    {"NegativeIntensity",
     [](B& b) {
       addLight(b, {{"type", "point"}, {"intensity", -1}});
     },
     kRange, "-1 lies outside", "/extensions/KHR_lights_punctual/lights/0/intensity"},
    {"InnerConeAboveOuterByRounding",
     [](B& b) {
       addLight(b, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.463647619}, {"outerConeAngle", 0.463647609}}}});
     },
     "cone angles out of order", "cone angles", "/extensions/KHR_lights_punctual/lights/0"},
    {"InnerConeAboveTheDefaultOfTheOuter",
     [](B& b) {
       addLight(b, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.7853982}}}});
     },
     "cone angles out of order", "cone angles", "/extensions/KHR_lights_punctual/lights/0"},
    {"OuterConeBeyondARightAngle",
     [](B& b) {
       addLight(b, {{"type", "spot"}, {"spot", {{"outerConeAngle", 3}}}});
     },
     "cone angles out of order", "cone angles", "/extensions/KHR_lights_punctual/lights/0"},
};
INSTANTIATE_TEST_SUITE_P(Numbers, ForgivingTest, testing::ValuesIn(kNumbers),
                         [](const auto& instance) { return instance.param.name; });

const SmallFault kNodes[] = {
    {"MatrixNotQuiteAffine",
     [](B& b) { b.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.999999}; },
     "matrix off by rounding", "last row", "/nodes/0/matrix"},
    {"MatrixWithATraceOfPerspective",
     [](B& b) { b.json["nodes"][0]["matrix"] = {1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, -9e-5, 0, 0, 0, 1}; },
     "matrix off by rounding", "last row", "/nodes/0/matrix"},
    {"RotationOfLengthZero",
     [](B& b) {
       b.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "rotation of length 0", "not a unit quaternion", "/nodes/0/rotation"},
    {"SceneMissing", [](B& b) { b.json["scene"] = 5; }, "unknown value", "index 5 is not among the 1 scenes", "/scene"},
    {"RootListedTwice",
     [](B& b) {
       b.json["scenes"][0]["nodes"] = {0, 1, 0};
     },
     "scene with other nodes than roots", "node 0 is not a root, or is listed twice", "/scenes/0/nodes"},
    {"ChildOfAListedNode", [](B& b) { b.json["nodes"][1]["children"] = {0}; }, "scene with other nodes than roots",
     "node 0 is not a root", "/scenes/0/nodes"},
    {"ChildOfANodeOutsideTheScene",
     [](B& b) {
       b.add("nodes", {{"children", {0}}});
     },
     "scene with other nodes than roots", "node 0 is not a root", "/scenes/0/nodes"},
    {"NullMesh", [](B& b) { b.json["nodes"][0]["mesh"] = nullptr; }, "null", "the value is null", "/nodes/0/mesh"},
    {"NullExtensions", [](B& b) { b.json["nodes"][0]["extensions"] = nullptr; }, "null", "the value is null",
     "/nodes/0/extensions"},
    {"NullArray", [](B& b) { b.json["cameras"] = nullptr; }, "null", "the value is null", "/cameras"},
    {"VersionWithoutAMinor", [](B& b) { b.json["asset"]["version"] = "2"; }, "version without a minor",
     "version is '2'", "/asset/version"},
};
INSTANTIATE_TEST_SUITE_P(Nodes, ForgivingTest, testing::ValuesIn(kNodes),
                         [](const auto& instance) { return instance.param.name; });

/// Draws vertices 0, 1, 2 of the triangle and the largest index of the type.
template <class Index>
void addRestart(B& b, int componentType) {
  b.primitive()["indices"] =
      b.addAccessor(std::vector<Index>{0, 1, 2, static_cast<Index>(-1)}, componentType, "SCALAR");
}

const SmallFault kMeshes[] = {
    {"NoAttributes", [](B& b) { b.primitive().erase("attributes"); }, kSkipped, "'attributes' is missing",
     "/meshes/0/primitives/0", "/meshes/0/primitives/0/attributes"},
    {"EmptyAttributes", [](B& b) { b.primitive()["attributes"] = Json::object(); }, kSkipped, "POSITION is missing",
     "/meshes/0/primitives/0/attributes"},
    {"NormalsAlone",
     [](B& b) {
       b.primitive()["attributes"] = {{"NORMAL", 0}};
     },
     kSkipped, "POSITION is missing", "/meshes/0/primitives/0/attributes"},
    {"CountZero", [](B& b) { b.json["accessors"][0]["count"] = 0; }, kSkipped, "0 lies outside 1 to",
     "/accessors/0/count", "/meshes/0/primitives/0/attributes"},
    {"CountZeroWithoutAView",
     [](B& b) {
       b.json["accessors"][0]["count"] = 0;
       b.json["accessors"][0].erase("bufferView");
     },
     kSkipped, "0 lies outside 1 to", "/accessors/0/count", "/meshes/0/primitives/0/attributes"},
    {"CountZeroOfAnEmptyView",
     [](B& b) {
       b.json["accessors"][0]["count"] = 0;
       b.json["bufferViews"][0]["byteLength"] = 0;
     },
     kSkipped, "0 lies outside 1 to", "/accessors/0/count", "/meshes/0/primitives/0/attributes"},
    {"NoIndices",
     [](B& b) {
       b.primitive()["indices"] = b.add("accessors", {{"componentType", 5123}, {"count", 0}, {"type", "SCALAR"}});
     },
     kSkipped, "0 lies outside 1 to", "/accessors/2/count", "/meshes/0/primitives/0/attributes"},
    {"RestartOfBytes", [](B& b) { addRestart<std::uint8_t>(b, kUnsignedByte); }, "primitive restart",
     "index 255 is not among the 3 vertices", "/meshes/0/primitives/0/indices"},
    {"RestartOfShorts", [](B& b) { addRestart<std::uint16_t>(b, kUnsignedShort); }, "primitive restart",
     "index 65535 is not among the 3 vertices", "/meshes/0/primitives/0/indices"},
    {"RestartOfWords", [](B& b) { addRestart<std::uint32_t>(b, kUnsignedInt); }, "primitive restart",
     "index 4294967295 is not among the 3 vertices", "/meshes/0/primitives/0/indices"},
    {"NormalizedIndices",
     [](B& b) {
       const int indices = b.addIndices({0, 1, 2});
       b.json["accessors"][indices]["normalized"] = true;
       b.primitive()["indices"] = indices;
     },
     "normalized indices", "does not hold indices", "/meshes/0/primitives/0/indices"},
};

INSTANTIATE_TEST_SUITE_P(Meshes, ForgivingTest, testing::ValuesIn(kMeshes),
                         [](const auto& instance) { return instance.param.name; });

const SmallFault kMaterials[] = {
    {"LightOfAnUnknownKind",
     [](B& b) {
       b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}, {{"type", "area"}}};
       b.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
     },
     "unknown value", "'area' is none of point, spot, directional", "/extensions/KHR_lights_punctual/lights/1/type"},
    {"AlphaModeUnknown", [](B& b) { material(b)["alphaMode"] = "SORTED"; }, "unknown value",
     "'SORTED' is none of OPAQUE, MASK, BLEND", "/materials/0/alphaMode"},
    {"RequiredButHarmless",
     [](B& b) {
       b.json["extensionsUsed"] = {"KHR_xmp_json_ld"};
       b.json["extensionsRequired"] = {"KHR_xmp_json_ld"};
     },
     "required without need", "requires the extension KHR_xmp_json_ld", "/extensionsRequired/0"},
    {"RequiredButNotDeclared", [](B& b) { b.json["extensionsRequired"] = {"KHR_materials_ior"}; },
     "extension not declared", "not among extensionsUsed", "/extensionsRequired/0"},
};
INSTANTIATE_TEST_SUITE_P(Materials, ForgivingTest, testing::ValuesIn(kMaterials),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace importon::test
