#include <gtest/gtest.h>

#include "base/error.h"
#include "loader/image_builder.h"
#include "loader/load.h"
#include "scene/images/image_decode.h"

namespace importon::test {
namespace {

std::vector<uint> decoded(const Bytes& bytes) {
  std::vector<uint> texels(readImageSize(bytes, "test").texels());
  decodeImage(bytes, texels, "test");
  return texels;
}

std::string refusal(const Bytes& bytes) {
  try {
    (void)decoded(bytes);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(Image, PngKeepsItsBytesWithRedLowestAndRowsFromTheTop) {
  EXPECT_EQ(decoded(makePng(1, 2, {1, 2, 3, 4, 5, 6, 7, 8})), (std::vector<uint>{0x04030201u, 0x08070605u}));
}

/// 8 x 8 pixels of the same samples.
Bytes jpegOf(const Bytes& pixel, JpegKind kind) {
  Bytes samples;
  for (int i = 0; i < 64; ++i) samples.insert(samples.end(), pixel.begin(), pixel.end());
  return makeJpeg(8, 8, samples, kind);
}

void expectColor(const Bytes& jpeg, double red, double green, double blue) {
  const std::vector<uint> texels = decoded(jpeg);
  ASSERT_EQ(texels.size(), 64u);
  EXPECT_NEAR(static_cast<double>(texels[27] & 0xFFu), red, 3);
  EXPECT_NEAR(static_cast<double>(texels[27] >> 8 & 0xFFu), green, 3);
  EXPECT_NEAR(static_cast<double>(texels[27] >> 16 & 0xFFu), blue, 3);
  EXPECT_EQ(texels[27] >> 24, 0xFFu);
}

/// Two words a texel.
std::vector<uint> decodedDeep(const Bytes& bytes) {
  const ImageSize size = readImageSize(bytes, "test");
  EXPECT_TRUE(size.isDeep);
  std::vector<uint> texels(2 * size.texels());
  decodeImage(bytes, texels, "test", TexelDepth::sixteen);
  return texels;
}

TEST(Image, SixteenBitsAreKeptWhereAskedFor) {
  EXPECT_EQ(decodedDeep(makePng({.bitDepth = 16}, {0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC, 0xDE, 0xF0})),
            (std::vector<uint>{0x56781234u, 0xDEF09ABCu}));
  EXPECT_EQ(decodedDeep(makePng({.bitDepth = 16, .colorType = 0}, {0x12, 0x34})),
            (std::vector<uint>{0x12341234u, 0xFFFF1234u}));
  EXPECT_EQ(
      decodedDeep(makePng({.bitDepth = 16, .colorType = 2, .transparency = {0, 1, 0, 2, 0, 3}}, {0, 1, 0, 2, 0, 3})),
      (std::vector<uint>{0x00020001u, 0x00000003u}));
  EXPECT_FALSE(readImageSize(makePng(1, 1, {1, 2, 3, 4}), "test").isDeep);
}

TEST(Image, ReadsAllKindsOfPng) {
  const Bytes palette = {10, 20, 30, 40, 50, 60};
  EXPECT_EQ(decoded(makePng({.width = 2, .bitDepth = 1, .colorType = 3, .palette = palette}, {0x40})),
            (std::vector<uint>{0xFF1E140Au, 0xFF3C3228u}));
  EXPECT_EQ(decoded(makePng({.width = 2, .colorType = 3, .palette = palette, .transparency = {7}}, {0, 1})),
            (std::vector<uint>{0x071E140Au, 0xFF3C3228u}));
  EXPECT_EQ(decoded(makePng({.width = 2, .bitDepth = 4, .colorType = 0}, {0x1F})),
            (std::vector<uint>{0xFF111111u, 0xFFFFFFFFu}));
  EXPECT_EQ(decoded(makePng({.width = 2, .colorType = 0, .transparency = {0, 9}}, {9, 10})),
            (std::vector<uint>{0x00090909u, 0xFF0A0A0Au}));
}

TEST(Image, InterlacedPngsAreReadAsOthers) {
  Bytes grey;
  for (unsigned i = 0; i < 9 * 10; ++i) grey.push_back(static_cast<unsigned char>(i));
  EXPECT_EQ(decoded(makeInterlacedPng(9, 10, grey)),
            decoded(makePng({.width = 9, .height = 10, .colorType = 0}, grey)));
}

TEST(Image, ReadsWebp) {
  const Bytes rgba = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(decoded(makeWebp(1, 2, rgba)), (std::vector<uint>{0x04030201u, 0x08070605u}));
  Bytes even;
  for (int i = 0; i < 64; ++i) even.insert(even.end(), {200, 100, 50, 255});
  expectColor(makeWebp(8, 8, even, false), 200, 100, 50);
}

TEST(Image, ReadsAvif) {
  const Bytes avif = makeAvif(8, {200, 100, 50, 128});
  if (avif.empty()) GTEST_SKIP() << "libavif has no encoder here";
  EXPECT_EQ(decoded(avif), std::vector<uint>(64, 0x803264C8u));
  EXPECT_FALSE(readImageSize(avif, "test").isDeep);
  const Bytes deep = makeAvif(8, {1000, 500, 250, 1023}, 10);
  const std::vector<uint> texels = decodedDeep(deep);
  EXPECT_NEAR(static_cast<double>(texels[0] & 0xFFFFu), 1000 * 65535.0 / 1023, 2);
  EXPECT_NEAR(static_cast<double>(texels[0] >> 16), 500 * 65535.0 / 1023, 2);
  EXPECT_NEAR(static_cast<double>(texels[1] & 0xFFFFu), 250 * 65535.0 / 1023, 2);
  EXPECT_EQ(decoded(deep).size(), 64u);
}

TEST(Image, SixteenBitsAreCutToEight) {
  EXPECT_EQ(decoded(makePng({.bitDepth = 16}, {0x12, 0xFF, 0x34, 0xFF, 0x56, 0xFF, 0x78, 0xFF})),
            std::vector<uint>{0x78563412u});
}

TEST(Image, GreyAndMissingAlphaAreFilledIn) {
  EXPECT_EQ(decoded(makePng({.colorType = 0}, {0x40})), std::vector<uint>{0xFF404040u});
  EXPECT_EQ(decoded(makePng({.colorType = 2}, {1, 2, 3})), std::vector<uint>{0xFF030201u});
  EXPECT_EQ(decoded(makePng({.colorType = 4}, {0x40, 0x80})), std::vector<uint>{0x80404040u});
}

TEST(Image, ReadsAllKindsOfJpeg) {
  for (const JpegKind kind : {JpegKind::baseline, JpegKind::progressive, JpegKind::arithmetic})
    expectColor(jpegOf({200, 100, 50}, kind), 200, 100, 50);
  expectColor(jpegOf({120}, JpegKind::grey), 120, 120, 120);
}

TEST(Image, MixesTheInksOfAJpeg) {
  expectColor(jpegOf({55, 155, 205, 0}, JpegKind::inks), 200, 100, 50);
  expectColor(jpegOf({55, 155, 205, 127}, JpegKind::inks), 100, 50, 25);
  expectColor(jpegOf({200, 100, 50, 255}, JpegKind::adobeInks), 200, 100, 50);
  expectColor(jpegOf({200, 100, 50, 128}, JpegKind::adobeInks), 100, 50, 25);
}

TEST(Image, RefusesOtherFormats) {
  EXPECT_NE(refusal(toBytes("GIF89a")).find("not PNG, JPEG, WebP or AVIF"), std::string::npos);
  EXPECT_NE(refusal(toBytes("RIFF    WAVE")).find("not PNG, JPEG, WebP or AVIF"), std::string::npos);
  EXPECT_NE(refusal({}).find("empty"), std::string::npos);
}

TEST(Image, RefusesWhatIsCutOff) {
  const Bytes png = makePng(4, 4, Bytes(64, 100));
  const Bytes jpeg = makeJpeg(16, 16, Bytes(768, 200));
  const Bytes webp = makeWebp(4, 4, Bytes(64, 100)), avif = makeAvif(8, {1, 2, 3, 4});
  for (const Bytes& whole : {png, jpeg, webp, avif}) {
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
      EXPECT_NE(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))), "") << length;
    }
    EXPECT_EQ(refusal(whole), "");
  }
}

TEST(Image, RefusesAHugeDeclaredSizeBeforeDecoding) {
  EXPECT_NE(refusal(makePng({.width = 16385}, {1, 2, 3, 4})), "");
  EXPECT_NE(refusal(makePng({.width = 0x7FFFFFFF, .height = 1}, {1, 2, 3, 4})), "");
  EXPECT_NE(refusal(makePng({.width = 16384, .height = 16384}, Bytes(16384, 0))).find("texels"), std::string::npos);
}

#ifndef IMPORTON_HAS_KTX
TEST(Image, KtxIsNamedWhereItCannotBeRead) {
  const Bytes ktx = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n', 0, 0};
  EXPECT_NE(refusal(ktx).find("the image is KTX2, which this build of importon cannot read"), std::string::npos);
}
#endif

TEST(Image, OfAnAnimationIsRefused) {
  Bytes webp = toBytes("RIFF    WEBPVP8X");
  webp.insert(webp.end(), {10, 0, 0, 0, 2, 0, 0, 0, 7, 0, 0, 7, 0, 0});  // the flag of animations; 8 x 8
  webp[4] = static_cast<unsigned char>(webp.size() - 8);
  webp[5] = webp[6] = webp[7] = 0;
  EXPECT_NE(refusal(webp).find("animation"), std::string::npos) << refusal(webp);
}

TEST(Image, ColourChunksHaveNoEffect) {
  Bytes png = makePng(1, 1, {100, 100, 100, 255});
  const unsigned char gamma[] = {0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 1, 0x86, 0xA0, 0x31, 0xE8, 0x96, 0x5F};
  png.insert(png.begin() + 33, std::begin(gamma), std::end(gamma));  // after IHDR: gamma 1
  EXPECT_EQ(decoded(png), std::vector<uint>{0xFF646464u});
}

TEST(Image, RefusesSizeZero) { EXPECT_NE(refusal(makePng({.width = 0}, {1, 2, 3, 4})), ""); }

TEST(Image, AnUndecodableOneIsNamedByItsPointer) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Bytes png = makePng(4, 4, Bytes(64, 100));
  png.resize(png.size() / 2);
  builder.json["materials"][0]["emissiveTexture"]["index"] = builder.addTexture(png);
  const std::string error = errorOf(builder);
  EXPECT_NE(error.find("cannot be decoded"), std::string::npos) << error;
  EXPECT_NE(error.find("(test.glb#/images/0)"), std::string::npos) << error;
}

TEST(Image, OfSeveralBadOnesTheFirstIsNamed) {
  for (int repetition = 0; repetition < 20; ++repetition) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    Bytes png = makePng(4, 4, Bytes(64, 100));
    png.resize(60);
    Json& material = builder.json["materials"][0];
    material["emissiveTexture"]["index"] = builder.addTexture(png);
    material["normalTexture"]["index"] = builder.addTexture(png);
    EXPECT_NE(errorOf(builder).find("#/images/0)"), std::string::npos);
  }
}

}  // namespace
}  // namespace importon::test
