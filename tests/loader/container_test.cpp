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

struct Chunk {
  const char* type;  // four characters
  Bytes payload;
};

void append(Bytes& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<unsigned char>(word >> shift));
}

/// A .glb of any chunks, which are written as they are, with no padding added.
Bytes glbOf(const std::vector<Chunk>& chunks) {
  Bytes bytes = toBytes("glTF");
  append(bytes, 2);
  append(bytes, 0);
  for (const Chunk& chunk : chunks) {
    append(bytes, static_cast<std::uint32_t>(chunk.payload.size()));
    bytes.insert(bytes.end(), chunk.type, chunk.type + 4);
    bytes.insert(bytes.end(), chunk.payload.begin(), chunk.payload.end());
  }
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data() + 8, &size, sizeof size);
  return bytes;
}

/// The JSON of a triangle in a buffer of its own, or in the BIN chunk; `padding` follows it, to a multiple of 4 and
/// more.
Bytes jsonOf(bool hasUri, const std::string& padding = "") {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json buffer{{"byteLength", builder.binary.size()}};
  if (hasUri) buffer["uri"] = "data:application/octet-stream;base64," + base64(builder.binary);
  builder.json["buffers"] = Json::array({buffer});
  std::string text = builder.json.dump();
  while (text.size() % 4 != 0) text += ' ';
  return toBytes(text + padding);
}

const Bytes kTriangle = GltfBuilder::emissiveTriangle().binary;

std::string kindOf(const Bytes& file) {
  const std::vector<Warning> warnings = warningsOf(file);
  return warnings.size() == 1 ? warnings[0].kind : std::to_string(warnings.size());
}

TEST(Container, UnknownChunksArePassedOver) {
  const Bytes eight(8, 7);
  for (const Bytes& file : {glbOf({{"JSON", jsonOf(true)}, {"ABCD", eight}}),
                            glbOf({{"JSON", jsonOf(true)}, {"ABCD", {}}, {"EFGH", eight}}),
                            glbOf({{"JSON", jsonOf(false)}, {"ABCD", eight}, {"BIN\0", kTriangle}}),
                            glbOf({{"JSON", jsonOf(false)}, {"BIN\0", kTriangle}, {"ABCD", eight}})}) {
    EXPECT_EQ(errorOf(file), "");
    EXPECT_EQ(errorOf(file, kStrict), "");
  }
  EXPECT_EQ(kindOf(glbOf({{"JSON", jsonOf(true)}, {"ABCD", eight}})), "unknown chunk");
}

TEST(Container, ABinChunkMayBeMissingOrEmptyWhereNoBufferNeedsIt) {
  EXPECT_EQ(kindOf(glbOf({{"JSON", jsonOf(true)}})), "0");
  EXPECT_EQ(kindOf(glbOf({{"JSON", jsonOf(true)}, {"BIN\0", {}}})), "0");
  EXPECT_NE(errorOf(glbOf({{"JSON", jsonOf(false)}})).find("neither 'uri' nor a BIN chunk"), std::string::npos);
}

/// The BIN chunk is that of one buffer; others without a place of their data hold none.
TEST(Container, ABufferWithoutDataMayBeThereWhereNothingReadsIt) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}}, {{"byteLength", 1024}}};
  EXPECT_EQ(errorOf(builder, kStrict), "");
  builder.json["bufferViews"][0]["buffer"] = 1;
  EXPECT_NE(errorOf(builder).find("neither 'uri' nor a BIN chunk (test.glb#/buffers/1)"), std::string::npos);
}

TEST(Container, AWrongLengthInTheHeaderIsASmallFault) {
  for (const std::uint32_t length : {0u, 4u, 40u, 0xFFFFFFFFu}) {
    EXPECT_EQ(kindOf(glbWithWord(8, length)), "wrong length of a .glb") << length;
    EXPECT_NE(errorOf(glbWithWord(8, length), kStrict), "") << length;
  }
}

TEST(Container, ChunksWithoutPaddingAreASmallFault) {
  const Bytes file = glbOf({{"JSON", jsonOf(false, " ")}, {"BIN\0", kTriangle}});
  EXPECT_EQ(kindOf(file), "chunk without padding");
  EXPECT_NE(errorOf(file, kStrict).find("starts at byte"), std::string::npos);
}

TEST(Container, ALengthThatDoesNotCountThePaddingIsUnderstood) {
  Bytes file = glbOf({{"JSON", jsonOf(false, "    ")}, {"BIN\0", kTriangle}});
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + 12, sizeof length);
  length -= 3;
  std::memcpy(file.data() + 12, &length, sizeof length);
  EXPECT_EQ(errorOf(file), "");
}

TEST(LenientJson, CommentsAndTrailingCommasAreSmallFaults) {
  const std::string json = GltfBuilder::emissiveTriangle().json.dump();
  const std::string inside = json.substr(1, json.size() - 2);
  const auto file = [](const std::string& text) { return glbOf({{"JSON", toBytes(text)}, {"BIN\0", kTriangle}}); };
  const std::string buffers = R"(,"buffers":[{"byteLength":36}])";
  const auto padded = [&](std::string text, char fill) {
    while (text.size() % 4 != 0) text += fill;
    return file(text);
  };
  for (const std::string& text :
       {"{" + inside + buffers + ",}", "{" + inside + buffers.substr(0, buffers.size() - 1) + ",]}",
        "{ // why \"not\", }\n" + inside + buffers + "}", "{ /* [[ \" */" + inside + buffers + "/**/}",
        "{" + inside + buffers + "} // end"}) {
    EXPECT_EQ(kindOf(padded(text, ' ')), "JSON with extras") << text;
    EXPECT_NE(errorOf(padded(text, ' '), kStrict).find("the JSON is malformed"), std::string::npos) << text;
  }
  const std::string whole = "{" + inside + buffers + "}" + "    ";
  EXPECT_EQ(kindOf(padded(whole + std::string(4, '\0'), '\0')), "0");
}

TEST(LenientJson, KeepsWhatStandsInStrings) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["nodes"][0]["name"] = "a // b /* c */ ,] \" ,}";
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  builder.json["nodes"][0]["camera"] = 0;
  std::string text = builder.json.dump();
  text.insert(1, "/**/");
  text.insert(text.size() - 1, R"(,"buffers":[{"byteLength":36}])");
  while (text.size() % 4 != 0) text += ' ';
  Log log(Log::Verbosity::quiet);
  const Scene scene = load(glbOf({{"JSON", toBytes(text)}, {"BIN\0", kTriangle}}), log);
  EXPECT_EQ(scene.cameras.at(0).nodeName, "a // b /* c */ ,] \" ,}");
}

TEST(LenientJson, NanAndInfinityAreNamed) {
  for (const char* word : {"NaN", "Infinity", "-Infinity", "nan", "inf"}) {
    const std::string error = errorOf(toBytes(R"({"asset":{"version":"2.0"},"x":)" + std::string(word) + "}"));
    EXPECT_NE(error.find("for a number at byte 3"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(LenientJson, DepthIsBoundedBehindCommentsToo) {
  const std::string deep(1000000, '[');
  EXPECT_NE(errorOf(toBytes("{/*\"*/\"a\":" + deep)).find("nested deeper"), std::string::npos);
}

TEST(Container, TheJsonChunkMayBeginWithAByteOrderMark) {
  EXPECT_EQ(errorOf(glbOf({{"JSON",
                            [] {
                              Bytes json = jsonOf(true);
                              json.insert(json.begin(), {0xEF, 0xBB, 0xBF, ' '});
                              return json;
                            }()}})),
            "");
}

}  // namespace
}  // namespace importon::test
