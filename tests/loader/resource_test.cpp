#include <gtest/gtest.h>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "support/temporary_folder.h"

namespace importon::test {
namespace {

std::string text(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

/// A .gltf in a folder of its own whose buffer is a file.
class ExternalFiles : public testing::Test {
 protected:
  ExternalFiles() { writeFile(folder_ / "data.bin", text(builder_.binary)); }

  void setBuffer(const std::string& uri) {
    builder_.json["buffers"] = Json::array({{{"byteLength", builder_.binary.size()}, {"uri", uri}}});
  }
  Scene loadIt(OutsideFiles outside = OutsideFiles::refused) {
    writeFile(folder_ / "scene.gltf", builder_.json.dump());
    Log log(Log::Verbosity::quiet);
    return loadGltf(folder_ / "scene.gltf", log, {.outside = outside});
  }
  std::string error() {
    try {
      (void)loadIt();
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  void setTexture(const Json& texture) {
    builder_.json["textures"] = Json::array({texture});
    builder_.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  }
  /// The warnings of a load that succeeds, but those of coordinates.
  std::vector<std::string> warningsOf() {
    writeFile(folder_ / "scene.gltf", builder_.json.dump());
    Log log(Log::Verbosity::quiet);
    (void)loadGltf(folder_ / "scene.gltf", log);
    std::vector<std::string> messages;
    for (const Warning& warning : log.warnings())
      if (warning.kind != "texture without coordinates") messages.push_back(warning.message);
    return messages;
  }

  TemporaryFolder folder_;
  GltfBuilder builder_ = GltfBuilder::emissiveTriangle();
};

TEST_F(ExternalFiles, BuffersStandBesideTheGltf) {
  setBuffer("data.bin");
  EXPECT_EQ(loadIt().triangles.size(), 1u);
}

TEST_F(ExternalFiles, NamesMayBePercentEncodedAndHoldAPlus) {
  for (const char* name : {"with space.bin", "a+b.bin", "caf\xC3\xA9.bin", "100%.bin"}) {
    writeFile(folder_ / name, text(builder_.binary));
  }
  for (const char* uri :
       {"with%20space.bin", "with space.bin", "a+b.bin", "a%2Bb.bin", "caf%C3%A9.bin", "100%25.bin"}) {
    setBuffer(uri);
    EXPECT_EQ(error(), "") << uri;
  }
}

TEST_F(ExternalFiles, SubfoldersAreAllowed) {
  std::filesystem::create_directory(folder_ / "sub");
  writeFile(folder_ / "sub/data.bin", text(builder_.binary));
  setBuffer("sub/data.bin");
  EXPECT_EQ(error(), "");
}

TEST_F(ExternalFiles, ALongerBufferFileIsRead) {
  writeFile(folder_ / "data.bin", text(builder_.binary) + "more");
  setBuffer("data.bin");
  EXPECT_EQ(error(), "");
}

TEST_F(ExternalFiles, AShorterBufferFileIsRefused) {
  writeFile(folder_ / "data.bin", "short");
  setBuffer("data.bin");
  EXPECT_NE(error().find("byteLength is 36 but 'data.bin' holds 5 bytes"), std::string::npos);
  EXPECT_NE(error().find("#/buffers/0)"), std::string::npos);
}

TEST_F(ExternalFiles, APointerOfGitLfsIsNamed) {
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 36\n";
  setBuffer("data.bin");
  writeFile(folder_ / "data.bin", pointer);
  EXPECT_NE(error().find("pointer of Git LFS"), std::string::npos) << error();
  writeFile(folder_ / "pointer.glb", pointer);
  Log log(Log::Verbosity::quiet);
  EXPECT_THROW((void)loadGltf(folder_ / "pointer.glb", log), SceneError);
}

TEST_F(ExternalFiles, AMissingBufferIsNamed) {
  setBuffer("missing.bin");
  EXPECT_NE(error().find("the file 'missing.bin' is missing"), std::string::npos);
  EXPECT_NE(error().find("#/buffers/0/uri)"), std::string::npos);
}

TEST_F(ExternalFiles, AMissingBufferThatNothingReadsIsNotAskedFor) {
  setBuffer("data.bin");
  for (const Json& more : {Json{{"byteLength", 36}, {"uri", "missing.bin"}}, Json{{"byteLength", 1024}}}) {
    builder_.json["buffers"][1] = more;
    EXPECT_EQ(warningsOf(), (std::vector<std::string>{})) << more;
  }
  builder_.json["bufferViews"][0]["buffer"] = 1;
  EXPECT_NE(error().find("neither 'uri' nor a BIN chunk"), std::string::npos) << error();
  builder_.json["buffers"][1]["uri"] = "missing.bin";
  EXPECT_NE(error().find("the file 'missing.bin' is missing"), std::string::npos) << error();
}

TEST_F(ExternalFiles, AMissingImageThatNothingShowsIsNotAskedFor) {
  setBuffer("data.bin");
  builder_.add("textures", {{"source", builder_.add("images", {{"uri", "missing.png"}})}});
  EXPECT_EQ(warningsOf(), (std::vector<std::string>{}));
}

TEST_F(ExternalFiles, AMissingImageLeavesTheFactorWithOneWarning) {
  setBuffer("data.bin");
  for (const char* uri : {"missing.png", "http://host/a.png", "C:\\a.png", "C:/a.png", ""}) {
    setTexture({{"source", builder_.add("images", {{"uri", uri}})}});
    EXPECT_EQ(loadIt().materials[0].baseColorTexture, kNone) << uri;
    const std::vector<std::string> warnings = warningsOf();
    ASSERT_EQ(warnings.size(), 1u) << uri;
    EXPECT_NE(warnings[0].find(uri), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[0].find("/uri: "), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings[0].find("scene.gltf"), warnings[0].rfind("scene.gltf")) << warnings[0];
    EXPECT_NE(warnings[0].find("factor stands alone"), std::string::npos) << warnings[0];
  }
}

TEST_F(ExternalFiles, AnImageOutsideTheFolderIsRefusedWhereUsed) {
  setBuffer("data.bin");
  setTexture({{"source", builder_.add("images", {{"uri", "../a.png"}})}});
  EXPECT_NE(error().find("leaves the folder"), std::string::npos) << error();
}

TEST_F(ExternalFiles, TheNextBestImageStandsInForAMissingOne) {
  setBuffer("data.bin");
  writeFile(folder_ / "there.png", text(makePng(1, 1, {1, 2, 3, 4})));
  const int there = builder_.add("images", {{"uri", "there.png"}});
  const int missing = builder_.add("images", {{"uri", "missing.webp"}});
  const auto withWebp = [](int image) { return Json{{"EXT_texture_webp", {{"source", image}}}}; };
  for (const Json& texture :
       {Json{{"source", there}, {"extensions", withWebp(missing)}},
        Json{{"source", missing}, {"extensions", withWebp(there)}}, Json{{"extensions", withWebp(there)}}}) {
    setTexture(texture);
    EXPECT_EQ(loadIt().texels, std::vector<uint>{0x04030201u}) << texture;
  }
}

TEST_F(ExternalFiles, BackslashesAreRepairedWithAWarning) {
  std::filesystem::create_directory(folder_ / "sub");
  writeFile(folder_ / "sub/data.bin", text(builder_.binary));
  setBuffer("sub\\data.bin");
  const std::vector<std::string> warnings = warningsOf();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("backslashes"), std::string::npos) << warnings[0];
}

TEST_F(ExternalFiles, AnEscapedColonIsPartOfAName) {
  writeFile(folder_ / "a:b.bin", text(builder_.binary));
  setBuffer("a%3Ab.bin");
  EXPECT_EQ(error(), "");
}

TEST_F(ExternalFiles, UrisThatLeaveTheFolderAreRefused) {
  for (const std::string& uri : {std::string("../data.bin"), std::string("%2E%2E/data.bin"),
                                 (folder_ / "data.bin").string(), std::string("sub/../../data.bin")}) {
    setBuffer(uri);
    EXPECT_NE(error().find("leaves the folder"), std::string::npos) << uri;
  }
}

TEST_F(ExternalFiles, UrisThatAreNoPathsHaveErrorsOfTheirOwn) {
  setBuffer("http://localhost/data.bin");
  EXPECT_NE(error().find("a scheme or a drive"), std::string::npos) << error();
  setBuffer("");
  EXPECT_NE(error().find("the URI is empty"), std::string::npos) << error();
  setBuffer("a%00b");
  EXPECT_NE(error().find("holds a NUL"), std::string::npos) << error();
}

TEST_F(ExternalFiles, LinksThatLeaveTheFolderAreRefused) {
  const TemporaryFolder elsewhere;
  writeFile(elsewhere / "data.bin", text(builder_.binary));
  std::filesystem::create_symlink(elsewhere / "data.bin", folder_ / "link.bin");
  std::filesystem::create_directory_symlink(elsewhere.path(), folder_ / "sub");
  std::filesystem::create_symlink("data.bin", folder_ / "inside.bin");
  for (const char* uri : {"link.bin", "sub/data.bin"}) {
    setBuffer(uri);
    EXPECT_NE(error().find("leaves the folder"), std::string::npos) << uri;
    EXPECT_EQ(loadIt(OutsideFiles::allowed).triangles.size(), 1u) << uri;
  }
  setBuffer("inside.bin");
  EXPECT_EQ(error(), "");
}

TEST_F(ExternalFiles, OutsideFilesAreReadWhereAllowed) {
  const TemporaryFolder elsewhere;
  writeFile(elsewhere / "data.bin", text(builder_.binary));
  const std::string absolute = elsewhere / "data.bin",
                    relative = "../" + elsewhere.path().filename().string() + "/data.bin";
  for (const std::string& uri : {absolute, relative}) {
    setBuffer(uri);
    EXPECT_NE(error().find("--allow-outside-files"), std::string::npos) << uri;
    EXPECT_EQ(loadIt(OutsideFiles::allowed).triangles.size(), 1u) << uri;
  }
}

TEST_F(ExternalFiles, AFolderIsNoBuffer) {
  std::filesystem::create_directory(folder_ / "sub");
  setBuffer("sub");
  EXPECT_NE(error().find("is missing"), std::string::npos);
}

TEST_F(ExternalFiles, ImagesAndBuffersDoNotGetMixedUp) {
  setBuffer("data.bin");
  for (const int value : {10, 20}) {
    const auto level = static_cast<unsigned char>(value);
    writeFile(folder_ / (std::to_string(value) + ".png"), text(makePng(1, 1, {level, 0, 0, 255})));
    builder_.add("textures", {{"source", builder_.add("images", {{"uri", std::to_string(value) + ".png"}})}});
  }
  builder_.json["materials"][0]["normalTexture"]["index"] = 0;
  builder_.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
  const Scene scene = loadIt();
  const auto red = [&](uint texture) { return scene.texels[scene.textures[texture].firstTexel] & 0xFFu; };
  EXPECT_EQ(red(scene.materials[0].normalTexture), 10u);
  EXPECT_EQ(red(scene.materials[0].baseColorTexture), 20u);
}

TEST_F(ExternalFiles, AnEmptyImageIsRefusedWhenUsed) {
  setBuffer("data.bin");
  writeFile(folder_ / "empty.png", "");
  builder_.add("textures", {{"source", builder_.add("images", {{"uri", "empty.png"}})}});
  builder_.json["materials"][0]["emissiveTexture"]["index"] = 0;
  EXPECT_NE(error().find("the image is empty"), std::string::npos) << error();
}

TEST_F(ExternalFiles, AFolderIsNoScene) {
  Log log(Log::Verbosity::quiet);
  EXPECT_THROW((void)loadGltf(folder_.path(), log), SceneError);
}

TEST_F(ExternalFiles, AreRefusedFromMemory) {
  setBuffer("data.bin");
  EXPECT_NE(errorOf(toBytes(builder_.json.dump())).find("read from memory"), std::string::npos);
}

std::string bufferError(const Json& buffer) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.json["buffers"] = Json::array({buffer});
  return errorOf(toBytes(builder.json.dump()));
}

TEST(DataUri, OfABufferMustFitItsLength) {
  EXPECT_NE(bufferError({{"byteLength", 36}, {"uri", "data:application/octet-stream;base64,QUJD"}})
                .find("byteLength is 36 but the data URI holds 3 bytes"),
            std::string::npos);
}

TEST(DataUri, MayHoldMoreThanTheBuffer) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Bytes longer = builder.binary;
  longer.resize(longer.size() + 5);
  for (const char* head : {"data:application/octet-stream;base64,", "data:;base64,", "data:text/html;base64,"}) {
    builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", head + base64(longer)}}};
    EXPECT_EQ(errorOf(toBytes(builder.json.dump())), "") << head;
  }
}

TEST(DataUri, MustBeWellFormed) {
  EXPECT_NE(bufferError({{"byteLength", 36}, {"uri", "data:application/octet-stream;base64,QU*D"}}).find("malformed"),
            std::string::npos);
  EXPECT_NE(bufferError({{"byteLength", 36}, {"uri", "data:application/octet-stream"}}).find("malformed"),
            std::string::npos);
}

TEST(DataUri, MessagesStayShort) {
  const std::string error = bufferError({{"byteLength", 36}, {"uri", "data:" + std::string(100000, 'x')}});
  EXPECT_LT(error.size(), 400u);
}

TEST(Buffer, NeedsDataFromSomewhere) {
  EXPECT_NE(bufferError({{"byteLength", 36}}).find("neither 'uri' nor a BIN chunk"), std::string::npos);
}

TEST(Buffer, LongerThanTheBinChunkIsRefused) {
  const GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Json json = builder.json;
  json["buffers"] = Json::array({{{"byteLength", 2000000000}}});
  EXPECT_NE(errorOf(makeGlb(json.dump(), builder.binary)).find("holds 36 bytes (test.glb#/buffers/0)"),
            std::string::npos);
}

TEST(ImageSource, MayBeADataUri) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("images", {{"uri", "data:image/png;base64," + base64(makePng(1, 1, {1, 2, 3, 4}))}});
  builder.add("textures", {{"source", 0}});
  builder.json["materials"][0]["normalTexture"]["index"] = 0;
  EXPECT_EQ(load(builder).texels, std::vector<uint>{0x04030201u});
}

TEST(ImageSource, OfAnyMediaTypeIsToldByItsBytes) {
  for (const char* head : {"data:image/jpg;base64,", "data:image/webp;base64,", "data:;base64,"}) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.add("images", {{"uri", head + base64(makePng(1, 1, {1, 2, 3, 4}))}, {"mimeType", "image/gif"}});
    builder.add("textures", {{"source", 0}});
    builder.json["materials"][0]["normalTexture"]["index"] = 0;
    EXPECT_EQ(load(builder).texels, std::vector<uint>{0x04030201u}) << head;
  }
}

TEST(ImageSource, AnAlternativeThatIsNotNeededIsNotRead) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("images", {{"uri", "data:image/png;base64," + base64(makePng(1, 1, {1, 2, 3, 4}))}});
  builder.add("images", {{"uri", "data:image/webp;base64,!"}});
  builder.add("textures", {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}});
  builder.json["materials"][0]["normalTexture"]["index"] = 0;
  EXPECT_EQ(load(builder).texels, std::vector<uint>{0x04030201u});
}

TEST(ImageSource, IsEitherAUriOrAView) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  builder.add("images", {{"uri", "a.png"}, {"bufferView", 0}});
  builder.add("textures", {{"source", 0}});
  EXPECT_EQ(errorOf(builder), "") << "nothing shows it";
  builder.json["materials"][0]["normalTexture"]["index"] = 0;
  EXPECT_NE(errorOf(builder).find("either 'uri' or 'bufferView' (test.glb#/images/0)"), std::string::npos);
  builder.json["images"][0] = Json::object();
  EXPECT_NE(warningsOf(builder).at(0).message.find("neither 'uri' nor 'bufferView'"), std::string::npos);
}

}  // namespace
}  // namespace importon::test
