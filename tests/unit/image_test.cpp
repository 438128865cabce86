#include "io/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "io/png.h"
#include "support/temporary_folder.h"

namespace importon::image_test {
namespace {

using test::readFile;
using test::TemporaryFolder;
using test::writeFile;

Image sample(int width, int height, const std::vector<std::string>& names) {
  Image image;
  image.width = width;
  image.height = height;
  float value = 0.1F;
  for (const std::string& name : names) {
    image.channels.push_back({name, {}});
    for (int i = 0; i < width * height; ++i) image.channels.back().values.push_back(value += 1.37F);
  }
  return image;
}

TEST(Exr, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  Image image = sample(13, 7, {"B", "G", "R", "albedo.R", "depth.Z"});
  image.channels[0].values[3] = std::numeric_limits<float>::infinity();
  image.channels[1].values[4] = -1e-38F;
  image.attributes["importon:version"] = "0.1.0";
  writeExr(folder / "a.exr", image);
  const Image read = readExr(folder / "a.exr");
  EXPECT_EQ(read.width, 13);
  EXPECT_EQ(read.height, 7);
  EXPECT_EQ(read.attributes.at("importon:version"), "0.1.0");
  ASSERT_EQ(read.channels.size(), 5u);
  for (const Channel& channel : image.channels) {
    ASSERT_NE(read.find(channel.name), nullptr) << channel.name;
    EXPECT_EQ(read.find(channel.name)->values, channel.values);
  }
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Exr, WritesTheSameBytesForTheSameImage) {
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", sample(20, 20, {"R", "G", "B"}));
  writeExr(folder / "b.exr", sample(20, 20, {"R", "G", "B"}));
  EXPECT_EQ(readFile(folder / "a.exr"), readFile(folder / "b.exr"));
}

TEST(Exr, FindsNoChannelThatIsNotThere) { EXPECT_EQ(sample(1, 1, {"R"}).find("G"), nullptr); }

// A half-float tiled file whose data window does not start at the origin, as other programs write them.
TEST(Exr, ReadsHalfFloatTilesWithAnOffset) {
  const TemporaryFolder folder;
  const std::string file = folder / "tiles.exr";
  constexpr int kWidth = 5, kHeight = 3;
  std::vector<half> values;
  for (int i = 0; i < kWidth * kHeight; ++i) values.emplace_back(static_cast<float>(i) * 0.5F);
  const Imath::Box2i window({10, 20}, {10 + kWidth - 1, 20 + kHeight - 1});
  {
    Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.setTileDescription(Imf::TileDescription(2, 2, Imf::ONE_LEVEL));
    Imf::TiledOutputFile exr(file.c_str(), header);
    Imf::FrameBuffer frameBuffer;
    frameBuffer.insert("Y", Imf::Slice::Make(Imf::HALF, values.data(), window));
    exr.setFrameBuffer(frameBuffer);
    exr.writeTiles(0, exr.numXTiles() - 1, 0, exr.numYTiles() - 1);
  }
  const Image image = readExr(file);
  EXPECT_EQ(image.width, kWidth);
  EXPECT_EQ(image.height, kHeight);
  const Channel* channel = image.find("Y");
  ASSERT_NE(channel, nullptr);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(channel->values[i], static_cast<float>(values[i]));
}

TEST(Exr, KeepsWhereAPartBelongs) {
  const TemporaryFolder folder;
  Image part = sample(7, 5, {"R", "depth.Z"});
  part.whole = {640, 480, 100, 40};
  writeExr(folder / "a.exr", part);
  const Image read = readExr(folder / "a.exr");
  EXPECT_EQ(read.width, 7);
  EXPECT_EQ(read.height, 5);
  EXPECT_EQ(read.whole.width, 640);
  EXPECT_EQ(read.whole.height, 480);
  EXPECT_EQ(read.whole.x, 100);
  EXPECT_EQ(read.whole.y, 40);
  for (const Channel& channel : part.channels) EXPECT_EQ(read.find(channel.name)->values, channel.values);
  writeExr(folder / "b.exr", sample(7, 5, {"R"}));
  EXPECT_EQ(readExr(folder / "b.exr").whole.width, 0);
}

TEST(Exr, RefusesSubsampledChannels) {
  const TemporaryFolder folder;
  const std::string file = folder / "chroma.exr";
  {
    Imf::Header header(4, 4);
    header.channels().insert("RY", Imf::Channel(Imf::HALF, 2, 2));
    Imf::OutputFile exr(file.c_str(), header);
    std::vector<half> values(4);
    Imf::FrameBuffer frameBuffer;
    frameBuffer.insert("RY", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), 2, 4, 2, 2));
    exr.setFrameBuffer(frameBuffer);
    exr.writePixels(4);
  }
  EXPECT_THROW((void)readExr(file), SceneError);
}

TEST(Exr, RefusesWhatIsNoWholeExrFile) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)readExr(folder / "missing.exr"), SceneError);
  EXPECT_THROW((void)readExr(folder.path()), SceneError);
  writeFile(folder / "text.exr", "not an image");
  EXPECT_THROW((void)readExr(folder / "text.exr"), SceneError);
  writeFile(folder / "empty.exr", "");
  EXPECT_THROW((void)readExr(folder / "empty.exr"), SceneError);
  writeExr(folder / "whole.exr", sample(64, 64, {"R", "G", "B"}));
  const std::string whole = readFile(folder / "whole.exr");
  for (const std::size_t part : {whole.size() / 2, whole.size() - 7, std::size_t{100}}) {
    writeFile(folder / "cut.exr", whole.substr(0, part));
    EXPECT_THROW((void)readExr(folder / "cut.exr"), SceneError) << part;
  }
}

TEST(Exr, RefusesAHeaderThatClaimsTooMuch) {
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", sample(4, 4, {"R"}));
  std::string bytes = readFile(folder / "a.exr");
  // The attribute's name and type, its size of 16 bytes, then xMin, yMin, xMax, yMax.
  const std::string name("dataWindow\0box2i\0", 17);
  const std::size_t window = bytes.find(name) + name.size() + 4;
  const int huge = 1 << 24;
  std::memcpy(bytes.data() + window + 8, &huge, 4);
  std::memcpy(bytes.data() + window + 12, &huge, 4);
  writeFile(folder / "a.exr", bytes);
  EXPECT_THROW((void)readExr(folder / "a.exr"), SceneError);
}

TEST(Exr, LeavesNothingWhenTheDiskIsFull) {
  EXPECT_THROW(writeExr("/dev/full", sample(64, 64, {"R", "G", "B"})), OutputError);
  const TemporaryFolder folder;
  EXPECT_THROW(writeExr(folder / "no/a.exr", sample(2, 2, {"R"})), OutputError);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Exr, TurnsAnImpossibleImageIntoAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeExr(folder / "a.exr", Image{}), OutputError);
  EXPECT_EQ(folder.entries(), 0);
}

struct Pixels {
  int width = 0, height = 0;
  std::vector<png_byte> rgb;
};

Pixels readPng(const std::filesystem::path& file) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&description, file.c_str()), 0);
  description.format = PNG_FORMAT_RGB;
  Pixels pixels{static_cast<int>(description.width), static_cast<int>(description.height), {}};
  pixels.rgb.resize(PNG_IMAGE_SIZE(description));
  EXPECT_NE(png_image_finish_read(&description, nullptr, pixels.rgb.data(), 0, nullptr), 0);
  return pixels;
}

TEST(Png, ShowsAnEvenImageAsMiddleGrey) {
  const TemporaryFolder folder;
  Image image{3, 2, {{"R", {}}, {"G", {}}, {"B", {}}}, {}};
  for (Channel& channel : image.channels) channel.values.assign(6, 123.F);
  writePng(folder / "a.png", image, {.toneMap = ToneMap::none});
  const Pixels pixels = readPng(folder / "a.png");
  EXPECT_EQ(pixels.width, 3);
  EXPECT_EQ(pixels.height, 2);
  // sRGB of 0.18 is 0.4614, times 255 is 117.6.
  for (const png_byte value : pixels.rgb) EXPECT_EQ(value, 118);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Png, ShowsLightTwiceForEachStepOfExposure) {
  const TemporaryFolder folder;
  const Image image{1, 1, {{"R", {0.05F}}, {"G", {0.05F}}, {"B", {0.05F}}}, {}};
  writePng(folder / "a.png", image, {.exposure = 2, .toneMap = ToneMap::none});
  // sRGB of 0.2 is 0.4845, times 255 is 123.6.
  for (const png_byte value : readPng(folder / "a.png").rgb) EXPECT_EQ(value, 124);
}

/// The neutral tone map takes 0.04 off what is 0.18.
TEST(Png, IsNeutralWithoutALook) {
  const TemporaryFolder folder;
  writePng(folder / "a.png", Image{1, 1, {{"R", {7}}, {"G", {7}}, {"B", {7}}}, {}});
  for (const png_byte value : readPng(folder / "a.png").rgb) EXPECT_EQ(value, 105);
}

TEST(Png, KeepsRowsAndChannelsInOrder) {
  const TemporaryFolder folder;
  writePng(folder / "a.png", {1, 2, {{"B", {0, 5}}, {"G", {0, 0}}, {"R", {5, 0}}}, {}}, {.toneMap = ToneMap::none});
  const Pixels pixels = readPng(folder / "a.png");
  EXPECT_GT(pixels.rgb[0], 0);  // red above
  EXPECT_EQ(pixels.rgb[2], 0);
  EXPECT_EQ(pixels.rgb[3], 0);
  EXPECT_GT(pixels.rgb[5], 0);  // blue below
}

/// The image is premultiplied, a PNG is not: half covered by what is as bright elsewhere, the colour is the same.
TEST(Png, HasAlphaWhereTheImageDoes) {
  const PngPixels pixels =
      shownPixels({3, 1, {{"A", {1, 0.5F, 0}}, {"R", {0.4F, 0.2F, 0}}, {"G", {0.2F, 0.1F, 0}}, {"B", {0, 0, 0}}}, {}},
                  1, ToneMap::neutral, "image");
  EXPECT_EQ(pixels.alpha, (std::vector<std::uint8_t>{255, 128, 0}));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(pixels.rgb[3 + c], pixels.rgb[c]);
    EXPECT_EQ(pixels.rgb[6 + c], 0);
  }
  const std::vector<std::byte> file = encodePng(pixels, "image");
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&description, file.data(), file.size()), 0);
  EXPECT_EQ(description.format & PNG_FORMAT_FLAG_ALPHA, static_cast<png_uint_32>(PNG_FORMAT_FLAG_ALPHA));
  description.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> rgba(PNG_IMAGE_SIZE(description));
  ASSERT_NE(png_image_finish_read(&description, nullptr, rgba.data(), 0, nullptr), 0);
  EXPECT_EQ(rgba[7], 128);
  EXPECT_EQ(rgba[4], pixels.rgb[0]);
  EXPECT_EQ(rgba[11], 0);
}

TEST(Png, MarksNotANumberInMagenta) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  writePng(folder / "a.png", {2, 1, {{"R", {1, 1}}, {"G", {1, nan}}, {"B", {1, 1}}}, {}});
  const Pixels pixels = readPng(folder / "a.png");
  EXPECT_EQ(pixels.rgb[3], 255);
  EXPECT_EQ(pixels.rgb[4], 0);
  EXPECT_EQ(pixels.rgb[5], 255);
}

TEST(Png, LeavesNothingWhenItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_THROW(writePng(folder / "no/a.png", sample(2, 2, {"R", "G", "B"})), OutputError);
  EXPECT_THROW(writePng(folder / "a.png", sample(2, 2, {"R"})), SceneError);
  EXPECT_THROW(writePng("/dev/full", sample(2, 2, {"R", "G", "B"})), OutputError);
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace importon::image_test
