// Pictures of all kinds, read back.
#include "io/picture_file.h"

#include <ImfChannelList.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "io/jpeg.h"
#include "io/png.h"
#include "scene/images/jpeg_decode.h"
#include "scene/images/png_decode.h"
#include "support/temporary_folder.h"

namespace importon::picture_file_test {
namespace {

using test::readFile;
using test::TemporaryFolder;

/// Smooth colours that differ from pixel to pixel.
Image gradient(int width, int height) {
  Image image{width, height, {{"R", {}}, {"G", {}}, {"B", {}}}, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.channels[0].values.push_back(static_cast<float>(x) / static_cast<float>(width));
      image.channels[1].values.push_back(0.5F);
      image.channels[2].values.push_back(static_cast<float>(y) / static_cast<float>(height));
    }
  }
  return image;
}

std::span<const unsigned char> bytesOf(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

constexpr Look kPlain{.exposure = 0, .toneMap = ToneMap::none};

TEST(PictureKind, FollowsTheExtension) {
  const auto kindOf = [](const char* file) { return pictureKind(file, PictureKind::exr); };
  EXPECT_EQ(kindOf("a.exr"), PictureKind::exr);
  EXPECT_EQ(kindOf("a.b.HDR"), PictureKind::hdr);
  EXPECT_EQ(kindOf("a.pic"), PictureKind::hdr);
  EXPECT_EQ(kindOf("x.exr/a.PNG"), PictureKind::png);
  EXPECT_EQ(kindOf("a.jpg"), PictureKind::jpeg);
  EXPECT_EQ(kindOf("a.JPeg"), PictureKind::jpeg);
  EXPECT_EQ(kindOf("/dev/null"), PictureKind::exr);
  EXPECT_EQ(pictureKind("out.d/plain", PictureKind::png), PictureKind::png);
  for (const char* other : {"a.tif", "a.exr2", "a.", "a.gltf"}) EXPECT_EQ(kindOf(other), std::nullopt) << other;
}

TEST(Hdr, GivesBackLightToAPartIn256OfTheBrightestChannel) {
  const TemporaryFolder folder;
  for (const int width : {1, 7, 8, 300}) {  // flat, and with run lengths
    Image image{width, 3, {{"R", {}}, {"G", {}}, {"B", {}}}, {}};
    for (int i = 0; i < 3 * width; ++i) {
      const float scale = std::exp2(static_cast<float>(i % 200 - 100));
      image.channels[0].values.push_back(scale * 1.9999F);
      image.channels[1].values.push_back(i % 3 == 0 ? 0 : scale * static_cast<float>(i % 97) / 96);
      image.channels[2].values.push_back(i % 5 < 4 ? 0 : scale);
    }
    writeHdr(folder / "a.hdr", image);
    EXPECT_TRUE(isHdr(folder / "a.hdr"));
    const Image read = readHdr(folder / "a.hdr");
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, 3);
    for (std::size_t i = 0; i < image.channels[0].values.size(); ++i) {
      EXPECT_NEAR(read.channels[0].values[i] / image.channels[0].values[i], 1, 1e-3) << "rounded up to a power of two";
      const float most = std::max(image.channels[0].values[i], image.channels[2].values[i]);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(read.channels[c].values[i], image.channels[c].values[i], most / 256) << width << " " << i;
    }
  }
}

TEST(Hdr, PacksWhatIsAlike) {
  const TemporaryFolder folder;
  Image flat{1000, 100, {{"R", {}}, {"G", {}}, {"B", {}}}, {}};
  for (Channel& channel : flat.channels) channel.values.assign(100'000, 0.25F);
  writeHdr(folder / "a.hdr", flat);
  EXPECT_LT(readFile(folder / "a.hdr").size(), 10'000u);
  EXPECT_EQ(readHdr(folder / "a.hdr").find("G")->values, flat.find("G")->values) << "powers of two are exact";
}

TEST(Hdr, HoldsWhatIsNoOrdinaryLight) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  writeHdr(folder / "a.hdr",
           {4, 1, {{"R", {nan, -1, infinity, 1e-45F}}, {"G", {0, 1, 1, 0}}, {"B", {0, 0, 0, 0}}}, {}});
  const Image read = readHdr(folder / "a.hdr");
  EXPECT_EQ(read.find("R")->values[0], 0);
  EXPECT_EQ(read.find("R")->values[1], 0);
  EXPECT_EQ(read.find("G")->values[1], 1);
  EXPECT_GT(read.find("R")->values[2], 1e38F);
  EXPECT_TRUE(std::isfinite(read.find("R")->values[2]));
  EXPECT_EQ(read.find("R")->values[3], 0);
  EXPECT_THROW(writeHdr(folder / "no/a.hdr", gradient(2, 2)), OutputError);
}

TEST(Jpeg, ShowsWhatAPngShows) {
  const TemporaryFolder folder;
  const Image image = gradient(40, 24);
  writeJpeg(folder / "a.jpg", image, kPlain);
  const std::string file = readFile(folder / "a.jpg");
  ASSERT_TRUE(isJpeg(bytesOf(file)));
  const ImageSize size = readJpegSize(bytesOf(file), "a.jpg");
  EXPECT_EQ(size.width, 40u);
  EXPECT_EQ(size.height, 24u);
  std::vector<uint> texels(40 * 24);
  decodeJpeg(bytesOf(file), texels, "a.jpg");
  const PngPixels png = shownPixels(image, 1, ToneMap::none, "");
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(static_cast<double>(texels[i] >> (8 * c) & 255u), png.rgb[3 * i + c], 12) << i << " " << c;
}

TEST(Jpeg, ShowsTransparentPixelsInFrontOfBlack) {
  const TemporaryFolder folder;
  Image image{8, 8, {}, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>(64, 0.25F)});
  image.channels.push_back({"A", std::vector<float>(64, 0.25F)});
  writeJpeg(folder / "a.jpg", image, kPlain);
  const std::string file = readFile(folder / "a.jpg");
  std::vector<uint> texels(64);
  decodeJpeg(bytesOf(file), texels, "a.jpg");
  EXPECT_NEAR(texels[0] & 255u, 137, 2) << "0.25 in sRGB, and not 1";
}

TEST(Jpeg, RefusesWhatItCannotHold) {
  const TemporaryFolder folder;
  Image wide{70'000, 1, {}, {}};
  for (const char* name : {"R", "G", "B"}) wide.channels.push_back({name, std::vector<float>(70'000)});
  EXPECT_THROW(writeJpeg(folder / "a.jpg", wide, kPlain), OutputError);
  EXPECT_THROW(writeJpeg(folder / "no/a.jpg", gradient(2, 2), kPlain), OutputError);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(DeepPng, HoldsShadesThatEightBitsDoNot) {
  const TemporaryFolder folder;
  Image image{256, 1, {{"R", {}}, {"G", {}}, {"B", {}}}, {}};
  for (int i = 0; i < 256; ++i)
    for (Channel& channel : image.channels) channel.values.push_back(0.5F + 1e-4F * static_cast<float>(i));
  writePng(folder / "a.png", image, {.exposure = 0, .toneMap = ToneMap::none, .isDeep = true});
  const std::string file = readFile(folder / "a.png");
  EXPECT_NE(file.find("sRGB"), std::string::npos);
  ASSERT_TRUE(readPngSize(bytesOf(file), "a.png").isDeep);
  std::vector<uint> texels(2 * 256);
  decodePng(bytesOf(file), texels, "a.png", TexelDepth::sixteen);
  for (int i = 0; i < 256; ++i) {
    const double linear = 0.5 + 1e-4 * i, srgb = 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    EXPECT_NEAR(texels[static_cast<std::size_t>(2 * i)] & 0xFFFFu, 65535 * srgb, 0.6) << i;
    EXPECT_EQ(texels[static_cast<std::size_t>(2 * i + 1)] >> 16, 0xFFFFu) << "opaque";
  }
}

TEST(DeepPng, HasOpacity) {
  const TemporaryFolder folder;
  const Image image{2, 1, {{"R", {0.25F, 0}}, {"G", {0.25F, 0}}, {"B", {0.25F, 0}}, {"A", {0.5F, 0}}}, {}};
  const DeepPngPixels pixels = deepShownPixels(image, 1, ToneMap::none, "");
  EXPECT_EQ(pixels.alpha[0], 32768);
  EXPECT_NEAR(pixels.rgb[0], 65535 * 0.735357, 2) << "0.5 in sRGB: not multiplied by the opacity";
  writePng(folder / "a.png", image, {.exposure = 0, .toneMap = ToneMap::none, .isDeep = true});
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&description, (folder / "a.png").c_str()), 0);
  EXPECT_NE(description.format & PNG_FORMAT_FLAG_ALPHA, 0u);
  png_image_free(&description);
}

TEST(HalfExr, HoldsTheChannelsThatAskForIt) {
  const TemporaryFolder folder;
  Image image = gradient(9, 5);
  image.channels[0].values[2] = 1e9F;
  image.channels[0].values[3] = -1e9F;
  image.channels[0].values[4] = std::numeric_limits<float>::infinity();
  for (Channel& channel : image.channels) channel.isHalf = true;
  image.channels.push_back({"P.X", std::vector<float>(45, 1234.5678F)});
  writeExr(folder / "a.exr", image);
  {
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::HALF);
    EXPECT_EQ(file.header().channels().findChannel("P.X")->type, Imf::FLOAT);
    ASSERT_TRUE(Imf::hasChromaticities(file.header()));
    EXPECT_EQ(Imf::chromaticities(file.header()), Imf::Chromaticities()) << "Rec. 709 with white D65";
  }
  const Image read = readExr(folder / "a.exr");
  EXPECT_EQ(read.find("P.X")->values, image.channels[3].values);
  for (std::size_t i = 0; i < 45; ++i)
    EXPECT_NEAR(read.find("B")->values[i], image.channels[2].values[i], std::exp2(-11)) << i;
  EXPECT_EQ(read.find("R")->values[2], 65504);
  EXPECT_EQ(read.find("R")->values[3], -65504);
  EXPECT_TRUE(std::isinf(read.find("R")->values[4]));
}

TEST(ExrMatrices, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  Image image = gradient(2, 2);
  ImageMatrix matrix{};
  for (std::size_t i = 0; i < 16; ++i) matrix[i] = static_cast<float>(i) + 0.5F;
  image.matrices["worldToCamera"] = matrix;
  writeExr(folder / "a.exr", image);
  EXPECT_EQ(readExr(folder / "a.exr").matrices, image.matrices);
}

TEST(WritePicture, ChoosesByTheName) {
  const TemporaryFolder folder;
  const auto startOf = [&](const char* name, PictureKind plain) {
    writePicture(folder / name, gradient(16, 16), kPlain, plain);
    return readFile(folder / name).substr(0, 4);
  };
  EXPECT_EQ(startOf("a.exr", PictureKind::png), "\x76\x2f\x31\x01");
  EXPECT_EQ(startOf("a.hdr", PictureKind::exr), "#?RA");
  EXPECT_EQ(startOf("a.png", PictureKind::exr), "\x89PNG");
  EXPECT_EQ(startOf("a.jpg", PictureKind::exr).substr(0, 3), "\xFF\xD8\xFF");
  EXPECT_EQ(startOf("plain", PictureKind::png), "\x89PNG");
  EXPECT_EQ(startOf("other", PictureKind::exr), "\x76\x2f\x31\x01");
}

}  // namespace
}  // namespace importon::picture_file_test
