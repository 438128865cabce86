#include <gtest/gtest.h>

#include "loader/load.h"
#include "scene/meshes/gltf_accessor.h"

namespace importon::test {
namespace {

/// The accessors of a builder, read one by one.
class Accessors : public testing::Test {
 protected:
  template <int N>
  std::vector<glm::vec<N, float>> floats(int accessor) {
    return readFloats<N>(document(), accessor, "/test");
  }
  std::vector<std::uint32_t> indices(int accessor) { return readIndices(document(), accessor, "/test"); }
  GltfDocument document() {
    Log log(Log::Verbosity::quiet);
    return readDocument(asBytes(builder_.glb()), "test.glb", {}, log);
  }
  GltfBuilder builder_;
};

TEST_F(Accessors, IntegersKeepTheirValues) {
  const std::vector<std::int8_t> bytes = {-128, -1, 0, 127};
  EXPECT_EQ(floats<2>(builder_.addAccessor(std::vector<glm::i8vec2>{{-128, 127}}, kByte, "VEC2"))[0],
            glm::vec2(-128, 127));
  EXPECT_EQ(floats<2>(builder_.addAccessor(std::vector<glm::u8vec2>{{0, 255}}, kUnsignedByte, "VEC2"))[0],
            glm::vec2(0, 255));
  EXPECT_EQ(floats<2>(builder_.addAccessor(std::vector<glm::i16vec2>{{-32768, 32767}}, kShort, "VEC2"))[0],
            glm::vec2(-32768, 32767));
  EXPECT_EQ(floats<2>(builder_.addAccessor(std::vector<glm::u16vec2>{{0, 65535}}, kUnsignedShort, "VEC2"))[0],
            glm::vec2(0, 65535));
}

TEST_F(Accessors, NormalisedIntegersReachOneAndNotBelowMinusOne) {
  const auto normalized = [&](int accessor) {
    builder_.json["accessors"][accessor]["normalized"] = true;
    return floats<2>(accessor)[0];
  };
  EXPECT_EQ(normalized(builder_.addAccessor(std::vector<glm::i8vec2>{{-128, 127}}, kByte, "VEC2")), glm::vec2(-1, 1));
  EXPECT_EQ(normalized(builder_.addAccessor(std::vector<glm::u8vec2>{{51, 255}}, kUnsignedByte, "VEC2")),
            glm::vec2(0.2f, 1));
  EXPECT_EQ(normalized(builder_.addAccessor(std::vector<glm::i16vec2>{{-32767, 32767}}, kShort, "VEC2")),
            glm::vec2(-1, 1));
  EXPECT_EQ(normalized(builder_.addAccessor(std::vector<glm::u16vec2>{{13107, 65535}}, kUnsignedShort, "VEC2")),
            glm::vec2(0.2f, 1));
}

TEST_F(Accessors, StrideSkipsWhatLiesBetween) {
  const float interleaved[] = {1, 2, 3, 99, 4, 5, 6, 99, 7, 8, 9};
  const int view = builder_.addView(interleaved, sizeof interleaved);
  builder_.json["bufferViews"][view]["byteStride"] = 16;
  const int accessor =
      builder_.add("accessors", {{"bufferView", view}, {"componentType", kFloat}, {"count", 3}, {"type", "VEC3"}});
  EXPECT_EQ(floats<3>(accessor), (std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST_F(Accessors, OffsetsNeedNoAlignment) {
  Bytes bytes(1 + sizeof(glm::vec2));
  const glm::vec2 value(0.25f, -3.5f);
  std::memcpy(bytes.data() + 1, &value, sizeof value);
  const int accessor = builder_.add("accessors", {{"bufferView", builder_.addView(bytes.data(), bytes.size())},
                                                  {"byteOffset", 1},
                                                  {"componentType", kFloat},
                                                  {"count", 1},
                                                  {"type", "VEC2"}});
  EXPECT_EQ(floats<2>(accessor)[0], value);
}

TEST_F(Accessors, ColoursWithoutAlphaAreOpaque) {
  const int accessor = builder_.addAccessor(std::vector<glm::vec3>{{0.1f, 0.2f, 0.3f}}, kFloat, "VEC3");
  EXPECT_EQ(floats<4>(accessor)[0], glm::vec4(0.1f, 0.2f, 0.3f, 1.0f));
}

TEST_F(Accessors, SparseValuesReplaceThoseOfTheView) {
  const int accessor = builder_.addPositions({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  const std::uint8_t places[] = {0, 2};
  const glm::vec3 values[] = {{7, 7, 7}, {9, 9, 9}};
  builder_.json["accessors"][accessor]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", builder_.addView(places, sizeof places)}, {"componentType", kUnsignedByte}}},
      {"values", {{"bufferView", builder_.addView(values, sizeof values)}}}};
  EXPECT_EQ(floats<3>(accessor), (std::vector<glm::vec3>{{7, 7, 7}, {2, 2, 2}, {9, 9, 9}}));
}

TEST_F(Accessors, SparseWithoutViewStartsFromZero) {
  const std::uint32_t place = 1;
  const glm::vec3 value(4, 5, 6);
  const int accessor = builder_.add(
      "accessors",
      {{"componentType", kFloat},
       {"count", 2},
       {"type", "VEC3"},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", builder_.addView(&place, sizeof place)}, {"componentType", kUnsignedInt}}},
         {"values", {{"bufferView", builder_.addView(&value, sizeof value)}}}}}});
  EXPECT_EQ(floats<3>(accessor), (std::vector<glm::vec3>{{0, 0, 0}, {4, 5, 6}}));
}

TEST_F(Accessors, IndicesComeInThreeWidths) {
  EXPECT_EQ(indices(builder_.addAccessor(std::vector<std::uint8_t>{0, 255}, kUnsignedByte, "SCALAR")),
            (std::vector<std::uint32_t>{0, 255}));
  EXPECT_EQ(indices(builder_.addAccessor(std::vector<std::uint16_t>{0, 65535}, kUnsignedShort, "SCALAR")),
            (std::vector<std::uint32_t>{0, 65535}));
  EXPECT_EQ(indices(builder_.addAccessor(std::vector<std::uint32_t>{0, 4000000000u}, kUnsignedInt, "SCALAR")),
            (std::vector<std::uint32_t>{0, 4000000000u}));
}

TEST_F(Accessors, SparseIndicesAreReplacedToo) {
  const int accessor = builder_.addIndices({5, 6, 7});
  const std::uint8_t place = 1;
  const std::uint16_t value = 60;
  builder_.json["accessors"][accessor]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", builder_.addView(&place, 1)}, {"componentType", kUnsignedByte}}},
      {"values", {{"bufferView", builder_.addView(&value, 2)}}}};
  EXPECT_EQ(indices(accessor), (std::vector<std::uint32_t>{5, 60, 7}));
}

TEST(QuantisedMesh, PositionsAreNormalisedIntegersUnderTheNodesScale) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int positions = builder.addAccessor(std::vector<glm::u16vec4>{{0, 0, 0, 0}, {65535, 0, 0, 0}, {0, 65535, 0, 0}},
                                            kUnsignedShort, "VEC3");
  builder.json["accessors"][positions]["normalized"] = true;
  const int view = builder.json["accessors"][positions]["bufferView"];
  builder.json["bufferViews"][view]["byteStride"] = 8;
  builder.primitive()["attributes"]["POSITION"] = positions;
  builder.json["nodes"][0]["scale"] = {2, 3, 4};
  builder.json["nodes"][0]["translation"] = {1, 1, 1};
  builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(load(builder).positions, (std::vector<vec3>{{1, 1, 1}, {3, 1, 1}, {1, 4, 1}}));
}

}  // namespace
}  // namespace importon::test
