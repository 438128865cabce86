/// EXT_meshopt_compression and KHR_meshopt_compression, of data that meshoptimizer itself encodes.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "loader/load.h"
#include "loader/pack_builder.h"
#include "scene/container/gltf_view.h"

namespace importon::test {
namespace {

/// What a view of the file holds.
Bytes bytesOf(const GltfBuilder& builder, int view) {
  Log log(Log::Verbosity::quiet);
  const GltfDocument document = readDocument(asBytes(builder.glb()), "test.glb", {}, log);
  const auto bytes = viewBytes(document, static_cast<std::size_t>(view));
  return Bytes(bytes.begin(), bytes.end());
}

std::string refusalOf(const GltfBuilder& builder, int view) {
  try {
    (void)bytesOf(builder, view);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

template <typename T>
std::vector<T> valuesOf(const Bytes& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

const std::vector<std::uint32_t> kIndices = {0, 1, 2, 2, 1, 3, 3, 1, 4};

TEST(Meshopt, AttributesComeBackAsTheyWere) {
  std::vector<glm::vec3> positions;
  for (int i = 0; i < 1000; ++i) positions.emplace_back(i, i * i, -0.5 * i);
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    GltfBuilder builder;
    const int view = addMeshoptView(builder, positions.data(), positions.size(), 12, "ATTRIBUTES", "NONE", name);
    EXPECT_EQ(valuesOf<glm::vec3>(bytesOf(builder, view)), positions) << name;
  }
}

TEST(Meshopt, IndicesComeBackAsTheyWere) {
  const std::vector<std::uint16_t> narrow(kIndices.begin(), kIndices.end());
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    GltfBuilder builder;
    const int wideView = addMeshoptView(builder, kIndices.data(), kIndices.size(), 4, mode);
    const int narrowView = addMeshoptView(builder, narrow.data(), narrow.size(), 2, mode);
    std::vector<std::uint32_t> wide = valuesOf<std::uint32_t>(bytesOf(builder, wideView));
    const std::vector<std::uint16_t> small = valuesOf<std::uint16_t>(bytesOf(builder, narrowView));
    EXPECT_TRUE(std::equal(wide.begin(), wide.end(), small.begin(), small.end()));
    if (std::string(mode) == "INDICES") {
      EXPECT_EQ(wide, kIndices);
    }
    std::sort(wide.begin(), wide.end());  // triangles may be turned
    std::vector<std::uint32_t> sorted = kIndices;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(wide, sorted);
  }
}

TEST(Meshopt, OctahedralNormalsAreUnfolded) {
  const std::vector<glm::vec4> normals = {{0, 0, 1, 0}, {0.6f, 0, -0.8f, 0}, {0, -1, 0, 0}, {0.36f, 0.48f, 0.8f, 0}};
  std::vector<glm::i16vec4> encoded(normals.size());
  meshopt_encodeFilterOct(encoded.data(), normals.size(), 8, 16, &normals[0].x);
  GltfBuilder builder;
  const int view = addMeshoptView(builder, encoded.data(), encoded.size(), 8, "ATTRIBUTES", "OCTAHEDRAL");
  const std::vector<glm::i16vec4> decoded = valuesOf<glm::i16vec4>(bytesOf(builder, view));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_LT(glm::length(glm::vec3(decoded[i]) / 32767.0f - glm::vec3(normals[i])), 2e-4f);
  }
}

TEST(Meshopt, QuaternionsGetTheirLongestComponentBack) {
  const std::vector<glm::vec4> turns = {{0, 0, 0, 1}, {0.5f, 0.5f, 0.5f, 0.5f}, {0.6f, 0, 0.8f, 0}, {0, 1, 0, 0}};
  std::vector<glm::i16vec4> encoded(turns.size());
  meshopt_encodeFilterQuat(encoded.data(), turns.size(), 8, 16, &turns[0].x);
  GltfBuilder builder;
  const int view = addMeshoptView(builder, encoded.data(), encoded.size(), 8, "ATTRIBUTES", "QUATERNION");
  const std::vector<glm::i16vec4> decoded = valuesOf<glm::i16vec4>(bytesOf(builder, view));
  for (std::size_t i = 0; i < turns.size(); ++i) {
    EXPECT_NEAR(std::abs(glm::dot(glm::vec4(decoded[i]) / 32767.0f, turns[i])), 1.0f, 1e-3f);
  }
}

TEST(Meshopt, ExponentialNumbersAreMultipliedOut) {
  const std::vector<float> values = {0, 1, -0.5f, 1024, 3.25f, -1e-3f, 7, 8};
  std::vector<std::uint32_t> encoded(values.size());
  meshopt_encodeFilterExp(encoded.data(), values.size(), 4, 24, values.data());
  GltfBuilder builder;
  const int view = addMeshoptView(builder, encoded.data(), encoded.size(), 4, "ATTRIBUTES", "EXPONENTIAL");
  const std::vector<float> decoded = valuesOf<float>(bytesOf(builder, view));
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(decoded[i], values[i], 1e-6 * std::abs(values[i]));
}

TEST(Meshopt, AWholeMeshLoads) {
  const Scene scene = load(packedFile());
  EXPECT_EQ(scene.triangles.size(), 7u);
  EXPECT_EQ(scene.textures.size(), 4u);
}

TEST(Meshopt, DataOfTheFallbackBufferNeedNoDecoding) {
  GltfBuilder builder;
  const std::vector<glm::vec3> positions(3, {1, 2, 3});
  const int view = addMeshoptView(builder, positions.data(), 3, 12);
  builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]["filter"] = "FUTURE";
  EXPECT_NE(refusalOf(builder, view).find("the filter FUTURE does not go with"), std::string::npos);
  const auto* first = reinterpret_cast<const unsigned char*>(positions.data());
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}},
                             {{"byteLength", 36},
                              {"uri", "data:;base64," + base64(std::span(first, 36))},
                              {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  EXPECT_EQ(valuesOf<glm::vec3>(bytesOf(builder, view)), positions);
}

TEST(Meshopt, AFallbackBufferHasNoBytesOfItsOwn) {
  GltfBuilder builder = packedFile();
  for (Json& view : builder.json["bufferViews"]) {
    if (view["buffer"] == 1) view.erase("extensions");
  }
  EXPECT_NE(errorOf(builder).find("it only stands in for compressed views"), std::string::npos) << errorOf(builder);
}

TEST(Meshopt, WhatOnlyKhrHasIsNamed) {
  GltfBuilder builder;
  const std::vector<glm::vec3> positions(3, {1, 2, 3});
  const int view = addMeshoptView(builder, positions.data(), 3, 12);
  Json& extension = builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
  const std::size_t offset = extension["byteOffset"].get<std::size_t>();
  builder.binary[offset] = 0xA1;
  EXPECT_NE(refusalOf(builder, view).find("version 1 of meshopt's attribute codec is not supported"),
            std::string::npos);
  builder.binary[offset] = 0xA0;
  extension["filter"] = "COLOR";
  EXPECT_NE(refusalOf(builder, view).find("the meshopt filter COLOR is not supported"), std::string::npos);
}

TEST(Meshopt, ShapesThatTheDecodersWouldNotBearAreRefused) {
  const auto refusal = [](const std::string& mode, const Json& change) {
    GltfBuilder builder;
    const int view = addMeshoptView(builder, kIndices.data(), kIndices.size(), 4, mode);
    builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"].update(change);
    return refusalOf(builder, view);
  };
  EXPECT_EQ(refusal("ATTRIBUTES", Json::object()), "");
  EXPECT_NE(refusal("ATTRIBUTES", {{"byteStride", 6}}).find("a byteStride of 6"), std::string::npos);
  EXPECT_NE(refusal("ATTRIBUTES", {{"byteStride", 260}}), "");
  EXPECT_NE(refusal("TRIANGLES", {{"byteStride", 3}}).find("a byteStride of 3"), std::string::npos);
  EXPECT_NE(refusal("TRIANGLES", {{"count", 8}}).find("8 indices make no triangles"), std::string::npos);
  EXPECT_NE(refusal("ATTRIBUTES", {{"count", 2147483647}}).find("cannot come of"), std::string::npos);
  EXPECT_NE(refusal("ATTRIBUTES", {{"filter", "QUATERNION"}}).find("does not go with"), std::string::npos);
  EXPECT_NE(refusal("INDICES", {{"filter", "EXPONENTIAL"}}).find("does not go with"), std::string::npos);
  EXPECT_NE(refusal("ATTRIBUTES", {{"byteOffset", 2147483647}}).find("lie outside the buffer"), std::string::npos);
  EXPECT_NE(refusal("ATTRIBUTES", {{"byteLength", 5}}), "");
  EXPECT_NE(refusal("ATTRIBUTES", {{"count", 8}}).find("bytes are decoded"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
