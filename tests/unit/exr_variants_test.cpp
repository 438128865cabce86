// OpenEXR files as other programs write them: every compression, pixel type, and way to arrange pixels.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon::exr_variants_test {
namespace {

using test::TemporaryFolder;

constexpr int kWidth = 37, kHeight = 35;  // no multiples of any block or tile
constexpr std::array kNames{"B", "G", "R"};

/// Smooth, between 0.5 and 1.5.
float valueAt(int x, int y, std::size_t channel) {
  return 0.5F + 0.5F * static_cast<float>(x) / kWidth + 0.4F * static_cast<float>(y) / kHeight +
         0.05F * static_cast<float>(channel);
}

template <class Value>
std::vector<Value> valuesOf(std::size_t channel) {
  std::vector<Value> values;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) values.push_back(static_cast<Value>(valueAt(x, y, channel)));
  return values;
}

/// Writes R, G, B of `type`, in scanlines or tiles.
template <class Value>
void writeAs(const std::string& file, Imf::PixelType type, Imf::Compression compression, bool isTiled) {
  Imf::Header header(kWidth, kHeight);
  header.compression() = compression;
  Imf::FrameBuffer frameBuffer;
  std::array<std::vector<Value>, 3> planes;
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = valuesOf<Value>(c);
    header.channels().insert(kNames[c], Imf::Channel(type));
    frameBuffer.insert(
        kNames[c], Imf::Slice(type, reinterpret_cast<char*>(planes[c].data()), sizeof(Value), sizeof(Value) * kWidth));
  }
  if (isTiled) {
    header.setTileDescription(Imf::TileDescription(16, 8, Imf::MIPMAP_LEVELS));
    Imf::TiledOutputFile exr(file.c_str(), header);
    exr.setFrameBuffer(frameBuffer);
    exr.writeTiles(0, exr.numXTiles() - 1, 0, exr.numYTiles() - 1);
  } else {
    Imf::OutputFile exr(file.c_str(), header);
    exr.setFrameBuffer(frameBuffer);
    exr.writePixels(kHeight);
  }
}

void expectValues(const std::string& file, float tolerance) {
  const Image image = readExr(file);
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel* channel = image.find(kNames[c]);
    ASSERT_NE(channel, nullptr);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        ASSERT_NEAR(channel->values[static_cast<std::size_t>(y * kWidth + x)], valueAt(x, y, c), tolerance)
            << kNames[c] << " at " << x << ", " << y;
  }
}

/// Half has 11 bits; B44, DWA and PXR24 lose some; the rest keeps all.
float toleranceOf(Imf::Compression compression, bool isHalf) {
  constexpr float kHalfStep = 1.F / 1024;
  switch (compression) {
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
      return 0.03F;
    case Imf::PXR24_COMPRESSION:
      return isHalf ? kHalfStep : 1.F / 32768;
    default:
      return isHalf ? kHalfStep : 0.F;
  }
}

TEST(ExrVariants, AllCompressionsAndPixelTypesAreRead) {
  const TemporaryFolder folder;
  const std::string file = folder / "a.exr";
  for (int i = 0; i < Imf::NUM_COMPRESSION_METHODS; ++i) {
    const auto compression = static_cast<Imf::Compression>(i);
    for (const bool isTiled : {false, true}) {
      SCOPED_TRACE(::testing::Message() << "compression " << i << (isTiled ? ", tiled" : ", scanlines"));
      writeAs<half>(file, Imf::HALF, compression, isTiled);
      expectValues(file, toleranceOf(compression, true));
      writeAs<float>(file, Imf::FLOAT, compression, isTiled);
      expectValues(file, toleranceOf(compression, false));
    }
  }
}

TEST(ExrVariants, WholeNumbersAreRead) {
  const TemporaryFolder folder;
  writeAs<unsigned>(folder / "a.exr", Imf::UINT, Imf::ZIP_COMPRESSION, false);
  const Image image = readExr(folder / "a.exr");
  EXPECT_EQ(image.find("R")->values.front(), 0);
  EXPECT_EQ(image.find("R")->values.back(), 1);
}

TEST(ExrVariants, LuminanceWithSubsampledChromaBecomesRgb) {
  const TemporaryFolder folder;
  const std::string file = folder / "yc.exr";
  constexpr int kSide = 8;
  {
    const std::vector<Imf::Rgba> pixels(kSide * kSide, Imf::Rgba(0.75F, 0.5F, 0.25F, 1.F));
    Imf::RgbaOutputFile exr(file.c_str(), kSide, kSide, Imf::WRITE_YC);
    exr.setFrameBuffer(pixels.data(), 1, kSide);
    exr.writePixels(kSide);
  }
  const Image image = readExr(file);
  constexpr std::array kExpected{0.25F, 0.5F, 0.75F};
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel* channel = image.find(kNames[c]);
    ASSERT_NE(channel, nullptr);
    ASSERT_EQ(channel->values.size(), std::size_t{kSide * kSide});
    for (const float value : channel->values) EXPECT_NEAR(value, kExpected[c], 0.01F);  // luminance keeps 7 bits
  }
}

/// Two parts of one size and a smaller one.
void writeParts(const std::string& file) {
  std::vector<Imf::Header> headers{Imf::Header(4, 2), Imf::Header(4, 2),
                                   Imf::Header(Imath::Box2i({0, 0}, {3, 1}), Imath::Box2i({0, 0}, {1, 1}))};
  const std::array<const char*, 3> names{"beauty", "diffuse", "proxy"};
  for (std::size_t part = 0; part < headers.size(); ++part) {
    headers[part].setName(names[part]);
    headers[part].setType(Imf::SCANLINEIMAGE);
    headers[part].channels().insert("R", Imf::Channel(Imf::FLOAT));
  }
  Imf::MultiPartOutputFile exr(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (int part = 0; part < 3; ++part) {
    std::vector<float> values(8, static_cast<float>(part + 1));
    Imf::FrameBuffer frameBuffer;
    const auto width = static_cast<std::size_t>(part == 2 ? 2 : 4);
    frameBuffer.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 4 * width));
    Imf::OutputPart output(exr, part);
    output.setFrameBuffer(frameBuffer);
    output.writePixels(2);
  }
}

TEST(ExrVariants, FurtherPartsAreLayers) {
  const TemporaryFolder folder;
  writeParts(folder / "parts.exr");
  const Image image = readExr(folder / "parts.exr");
  ASSERT_EQ(image.channels.size(), 2u);  // the proxy has another size
  EXPECT_EQ(image.find("R")->values, std::vector<float>(8, 1));
  EXPECT_EQ(image.find("diffuse.R")->values, std::vector<float>(8, 2));
}

}  // namespace
}  // namespace importon::exr_variants_test
