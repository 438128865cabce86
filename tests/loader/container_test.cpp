#include <gtest/gtest.h>

#include "loader/load.h"
#include "scene/container/gltf_container.h"

namespace importon::test {
namespace {

TEST(Container, GlbAndGltfWithDataUriGiveTheSameScene) {
  const GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Log log(Log::Verbosity::quiet);
  const Scene fromGlb = load(builder.glb(), log);
  const Scene fromGltf = load(builder.gltf(), log);
  ASSERT_EQ(fromGlb.triangles.size(), 1u);
  EXPECT_EQ(fromGlb.positions, fromGltf.positions);
  EXPECT_EQ(fromGlb.lights.size(), fromGltf.lights.size());
}

TEST(Container, RefusesAnEmptyFile) { EXPECT_NE(errorOf(Bytes()).find("empty"), std::string::npos); }

TEST(Container, RefusesAGlbCutOffAnywhere) {
  const Bytes whole = GltfBuilder::emissiveTriangle().glb();
  for (std::size_t length = 1; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_NE(errorOf(cut), "") << length;
  }
}

TEST(Container, RefusesAGltfCutOffAnywhere) {
  const Bytes whole = GltfBuilder::emissiveTriangle().gltf();
  for (std::size_t length = 1; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_NE(errorOf(cut), "") << length;
  }
}

Bytes glbWithWord(std::size_t offset, std::uint32_t word) {
  Bytes bytes = GltfBuilder::emissiveTriangle().glb();
  std::memcpy(bytes.data() + offset, &word, sizeof word);
  return bytes;
}

TEST(Container, RefusesWrongHeaderFields) {
  EXPECT_NE(errorOf(glbWithWord(4, 1)).find("version 1"), std::string::npos);
  EXPECT_NE(errorOf(glbWithWord(8, 0xFFFFFFFF), kStrict).find("says it has 4294967295 bytes"), std::string::npos);
  EXPECT_NE(errorOf(glbWithWord(8, 4), kStrict).find("says it has 4 bytes"), std::string::npos);
  EXPECT_NE(errorOf(glbWithWord(12, 0xFFFFFFFF)).find("reaches past the end"), std::string::npos);
  EXPECT_NE(errorOf(glbWithWord(16, 0)).find("no JSON chunk"), std::string::npos);
}

TEST(Container, RefusesABinChunkThatReachesPastTheEnd) {
  const GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Bytes bytes = builder.glb();
  const std::size_t chunkHeader = bytes.size() - builder.binary.size() - 8;
  for (const std::uint32_t excess : {4u, 8u, 0xFFFFFF00u}) {
    const auto length = static_cast<std::uint32_t>(builder.binary.size()) + excess;
    std::memcpy(bytes.data() + chunkHeader, &length, sizeof length);
    EXPECT_NE(errorOf(bytes).find("BIN chunk"), std::string::npos) << excess;
  }
}

TEST(Container, RefusesJsonNestedTooDeep) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const std::string text = builder.json.dump();
  for (const char* brackets : {"[]", "{}"}) {
    const std::string opening = brackets[0] == '[' ? "[" : "{\"a\":";
    std::string deep;
    for (int i = 0; i < 1000000; ++i) deep += opening;
    EXPECT_NE(errorOf(toBytes(R"({"asset":{"version":"2.0"},"extras":)" + deep)).find("nested deeper"),
              std::string::npos);
  }
}

TEST(Container, BracketsInStringsAreNoNesting) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["asset"]["generator"] = std::string(1000, '[') + "\\\"" + std::string(1000, '{');
  EXPECT_EQ(errorOf(builder), "");
}

}  // namespace
}  // namespace importon::test
