/// A table of malformed files and what is said of each. The message names the place by a JSON pointer.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "loader/load.h"

namespace importon::test {
namespace {

struct Malformed {
  const char* name;
  std::function<void(GltfBuilder&)> spoil;
  const char* message;  // a part of it
  const char* pointer;  // after "test.glb#"; nullptr: the file alone is named
};

void PrintTo(const Malformed& test, std::ostream* out) { *out << test.name; }

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithPlaceAndRemedy) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  GetParam().spoil(builder);
  const std::string error = errorOf(builder);
  EXPECT_NE(error.find(GetParam().message), std::string::npos) << error;
  const std::string where =
      GetParam().pointer == nullptr ? "(test.glb):" : std::string("(test.glb#") + GetParam().pointer + "):";
  EXPECT_NE(error.find(where), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

using B = GltfBuilder;

const Malformed kStructure[] = {
    {"NoAsset", [](B& b) { b.json.erase("asset"); }, "'asset' is missing", ""},
    {"NoVersion", [](B& b) { b.json["asset"].erase("version"); }, "'version' is missing", "/asset"},
    {"OldVersion", [](B& b) { b.json["asset"]["version"] = "1.0"; }, "needs glTF version 1.0", "/asset/version"},
    {"OldVersionWithObjects",
     [](B& b) {
       b.json["asset"]["version"] = "1.0";
       b.json["meshes"] = Json::object();
     },
     "needs glTF version 1.0", "/asset/version"},
    {"OldVersionAsNumber", [](B& b) { b.json["asset"]["version"] = 1.0; }, "needs glTF version 1.0", "/asset/version"},
    {"OldFileWithoutVersion",
     [](B& b) {
       b.json.erase("asset");
       b.json["meshes"] = Json::object();
     },
     "needs glTF version 1.0", "/meshes"},
    {"NewMinVersion", [](B& b) { b.json["asset"]["minVersion"] = "2.1"; }, "needs glTF version 2.1",
     "/asset/minVersion"},
    {"VersionIsNumber", [](B& b) { b.json["asset"]["version"] = 2; }, "expected a string", "/asset/version"},
    {"MeshesIsObject", [](B& b) { b.json["meshes"] = Json::object(); }, "expected an array of objects", "/meshes"},
    {"MeshIsNumber", [](B& b) { b.json["meshes"][0] = 1; }, "expected an array of objects", "/meshes/0"},
    {"NoPrimitives", [](B& b) { b.json["meshes"][0].erase("primitives"); }, "'primitives' is missing", "/meshes/0"},
    {"ModeTooLarge", [](B& b) { b.primitive()["mode"] = 7; }, "7 lies outside 0 to 6", "/meshes/0/primitives/0/mode"},
    {"ModeIsString", [](B& b) { b.primitive()["mode"] = "4"; }, "expected an integer", "/meshes/0/primitives/0/mode"},
    {"NodeMissing", [](B& b) { b.json["scenes"][0]["nodes"] = {9}; }, "index 9 is not among the 1 nodes",
     "/scenes/0/nodes/0"},
    {"NegativeIndex", [](B& b) { b.json["nodes"][0]["mesh"] = -1; }, "index -1 is not among", "/nodes/0/mesh"},
    {"HugeIndex", [](B& b) { b.json["nodes"][0]["mesh"] = 18446744073709551615u; },
     "index 18446744073709551615 is not among", "/nodes/0/mesh"},
    {"FractionalIndex", [](B& b) { b.json["nodes"][0]["mesh"] = 0.5; }, "expected an index", "/nodes/0/mesh"},
    {"MaterialMissing", [](B& b) { b.primitive()["material"] = 3; }, "index 3 is not among the 1 materials",
     "/meshes/0/primitives/0/material"},
    {"AccessorMissing", [](B& b) { b.primitive()["attributes"]["NORMAL"] = 77; },
     "index 77 is not among the 1 accessors", "/meshes/0/primitives/0/attributes/NORMAL"},
    {"AttributeNameWithSlash", [](B& b) { b.primitive()["attributes"]["a/b~c"] = 77; }, "index 77",
     "/meshes/0/primitives/0/attributes/a~1b~0c"},
};
INSTANTIATE_TEST_SUITE_P(Structure, MalformedFile, testing::ValuesIn(kStructure),
                         [](const auto& instance) { return instance.param.name; });

const Malformed kData[] = {
    {"NoCount", [](B& b) { b.json["accessors"][0].erase("count"); }, "'count' is missing", "/accessors/0"},
    {"CountPastView", [](B& b) { b.json["accessors"][0]["count"] = 4; },
     "4 elements of 12 bytes from byte 0 on reach past the buffer view of 36 bytes",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"CountOverflows", [](B& b) { b.json["accessors"][0]["count"] = 2147483647; }, "reach past the buffer view",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"CountBeyondIntegers", [](B& b) { b.json["accessors"][0]["count"] = 18446744073709551615u; }, "lies outside 0 to",
     "/accessors/0/count"},
    {"OffsetPastView", [](B& b) { b.json["accessors"][0]["byteOffset"] = 2147483647; }, "reach past the buffer view",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"UnknownComponentType", [](B& b) { b.json["accessors"][0]["componentType"] = 5124; }, "component type 5124",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"WrongType", [](B& b) { b.json["accessors"][0]["type"] = "VEC2"; }, "does not hold vectors of 3",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"MatrixForVector", [](B& b) { b.json["accessors"][0]["type"] = "MAT2"; }, "does not hold vectors of 3",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"UnknownType", [](B& b) { b.json["accessors"][0]["type"] = "VEC9"; }, "'VEC9' is none of SCALAR",
     "/accessors/0/type"},
    {"ViewMissing", [](B& b) { b.json["accessors"][0]["bufferView"] = 8; }, "index 8 is not among the 1 bufferViews",
     "/accessors/0/bufferView"},
    {"ViewPastBuffer", [](B& b) { b.json["bufferViews"][0]["byteLength"] = 37; },
     "bytes 0 to 37 lie outside the buffer of 36 bytes", "/bufferViews/0"},
    {"ViewOffsetPastBuffer", [](B& b) { b.json["bufferViews"][0]["byteOffset"] = 2147483647; },
     "lie outside the buffer of 36 bytes", "/bufferViews/0"},
    {"StrideTooSmall", [](B& b) { b.json["bufferViews"][0]["byteStride"] = 8; },
     "a stride of 8 bytes is less than an element of 12", "/meshes/0/primitives/0/attributes/POSITION"},
    {"StridePastView", [](B& b) { b.json["bufferViews"][0]["byteStride"] = 16; }, "reach past the buffer view",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"ZerosWithoutEnd",
     [](B& b) {
       b.json["accessors"][0].erase("bufferView");
       b.json["accessors"][0]["count"] = 2147483647;
     },
     "without a buffer view", "/meshes/0/primitives/0/attributes/POSITION"},
    {"UnequalCounts",
     [](B& b) {
       b.primitive()["attributes"]["NORMAL"] = b.addPositions({{0, 0, 1}, {0, 0, 1}});
     },
     "NORMAL has 2 elements but POSITION has 3", "/meshes/0/primitives/0/attributes/NORMAL"},
    {"IndexOutOfRange",
     [](B& b) {
       b.primitive()["indices"] = b.addIndices({0, 1, 3});
     },
     "index 3 is not among the 3 vertices", "/meshes/0/primitives/0/indices"},
    {"FloatIndices",
     [](B& b) {
       b.primitive()["indices"] = b.addAccessor(std::vector<float>{0, 1, 2}, kFloat, "SCALAR");
     },
     "indices must be unsigned integers", "/meshes/0/primitives/0/indices"},
    {"VectorIndices", [](B& b) { b.primitive()["indices"] = 0; }, "does not hold indices",
     "/meshes/0/primitives/0/indices"},
};
INSTANTIATE_TEST_SUITE_P(Data, MalformedFile, testing::ValuesIn(kData),
                         [](const auto& instance) { return instance.param.name; });

/// A sparse POSITION that moves vertex 0.
Json& makeSparse(B& b) {
  const int indices = b.addView("\0\0", 2);
  const glm::vec3 moved(0, 0, 1);
  const int values = b.addView(&moved, sizeof moved);
  b.json["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                                      {"values", {{"bufferView", values}}}};
  return b.json["accessors"][0]["sparse"];
}

const Malformed kSparse[] = {
    {"NoIndices", [](B& b) { makeSparse(b).erase("indices"); }, "'indices' is missing", "/accessors/0/sparse"},
    {"NoValues", [](B& b) { makeSparse(b).erase("values"); }, "'values' is missing", "/accessors/0/sparse"},
    {"CountPastIndices", [](B& b) { makeSparse(b)["count"] = 2; }, "reach past the buffer view",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"IndexPastCount",
     [](B& b) {
       makeSparse(b);
       b.binary[36] = 3;
     },
     "sparse index 3 is not among the 3 elements", "/meshes/0/primitives/0/attributes/POSITION"},
    {"FloatIndices", [](B& b) { makeSparse(b)["indices"]["componentType"] = kFloat; }, "reach past",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"NegativeOffset", [](B& b) { makeSparse(b)["values"]["byteOffset"] = -4; }, "-4 lies outside",
     "/accessors/0/sparse/values/byteOffset"},
};
INSTANTIATE_TEST_SUITE_P(Sparse, MalformedFile, testing::ValuesIn(kSparse),
                         [](const auto& instance) { return instance.param.name; });

const Malformed kMeaning[] = {
    {"ColourHasTwoNumbers",
     [](B& b) {
       b.json["materials"][0]["emissiveFactor"] = {1, 2};
     },
     "expected 3 numbers but found 2", "/materials/0/emissiveFactor"},
    {"ColourIsText",
     [](B& b) {
       b.json["materials"][0]["emissiveFactor"] = {1, "2", 3};
     },
     "expected a number", "/materials/0/emissiveFactor/1"},
    {"TextureMissing", [](B& b) { b.json["materials"][0]["emissiveTexture"]["index"] = 0; },
     "index 0 is not among the 0 textures", "/materials/0/emissiveTexture/index"},
    {"TextureWithoutIndex", [](B& b) { b.json["materials"][0]["normalTexture"] = Json::object(); },
     "'index' is missing", "/materials/0/normalTexture"},
    {"MatrixOfNine",
     [](B& b) {
       b.json["nodes"][0]["matrix"] = Json::array({1, 0, 0, 0, 1, 0, 0, 0, 1});
     },
     "expected 16 numbers but found 9", "/nodes/0/matrix"},
    {"ProjectiveMatrix", [](B& b) { b.json["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "last row", "/nodes/0/matrix"},
    {"UnknownRequiredExtension",
     [](B& b) {
       b.json["extensionsUsed"] = {"EXT_nobody_knows"};
       b.json["extensionsRequired"] = {"EXT_nobody_knows"};
     },
     "requires the extension EXT_nobody_knows", "/extensionsRequired/0"},
    {"ExtensionsRequiredIsText", [](B& b) { b.json["extensionsRequired"] = "KHR_x"; }, "expected an array of strings",
     "/extensionsRequired"},
    {"EnvironmentWithoutRadiance",
     [](B& b) {
       b.json["scenes"][0]["extras"]["environment"] = {{"type", "constant"}};
     },
     "needs 'radiance'", "/scenes/0/extras/environment"},
    {"EnvironmentOfTwoNumbers",
     [](B& b) {
       b.json["scenes"][0]["extras"]["environment"] = {{"type", "constant"}, {"radiance", {1, 2}}};
     },
     "expected 3 numbers", "/scenes/0/extras/environment/radiance"},
    {"NoTriangle", [](B& b) { b.json["scenes"][0]["nodes"] = Json::array(); }, "no triangle", nullptr},
};
INSTANTIATE_TEST_SUITE_P(Meaning, MalformedFile, testing::ValuesIn(kMeaning),
                         [](const auto& instance) { return instance.param.name; });

TEST(MalformedJson, IsRefused) {
  for (const char* text : {"{", "not JSON at all", "{\"asset\":{\"version\":\"2.0\"}} trailing", "{\"a\":1e999}",
                           "{\"asset\":{\"version\":\"\xFF\xFE\"}}", "[1,2"}) {
    EXPECT_NE(errorOf(toBytes(text)).find("the JSON is malformed"), std::string::npos) << text;
  }
}

TEST(MalformedJson, ItsRootIsAnObject) {
  EXPECT_NE(errorOf(toBytes("[1, 2, 3]")).find("the JSON is not an object (test.glb#)"), std::string::npos);
}

TEST(MalformedJson, InvalidUtf8InTheFileNameDoesNotCrash) {
  Log log(Log::Verbosity::quiet);
  EXPECT_THROW((void)loadGltf("\xFF\xFE missing.gltf", log), SceneError);
}

TEST(MissingFile, IsRefused) {
  Log log(Log::Verbosity::quiet);
  try {
    (void)loadGltf("no/such/file.glb", log);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.status(), ExitStatus::scene);
    EXPECT_NE(std::string(error.what()).find("does not exist (no/such/file.glb)"), std::string::npos) << error.what();
  }
}

TEST(UnknownExtensions, AreNamedInOneWarning) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["extensionsUsed"] = {"EXT_one", "KHR_materials_ior", "EXT_two"};
  const std::vector<Warning> warnings = warningsOf(builder);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].count, 1u);
  EXPECT_NE(warnings[0].message.find("EXT_one, EXT_two"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
