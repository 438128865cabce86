#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <exception>
#include <system_error>

#include "base/error.h"
#include "fmt/format.h"
#include "io/exr_header.h"
#include "io/image.h"

namespace importon {
namespace {

// A damaged header may claim any size; 2^30 values are 4 GiB.
constexpr std::int64_t kMostValues = std::int64_t{1} << 30;

/// Pixels that a byte of a file may stand for, in the mean, and values of all channels: no compression of a constant
/// image does better.
struct Density {
  std::int64_t pixels, values;
};
Density mostPerByte(Imf::Compression compression) {
  const bool isLossy = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  return isLossy ? Density{16384, 32768} : Density{1024, 4096};
}

/// Rows that are compressed as one. [OpenEXR File Layout]
std::int64_t rowsOfABlock(Imf::Compression compression) {
  switch (compression) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 1;
  }
}

/// The library takes memory for whole blocks and tiles, however few of their rows the image has.
void checkBlocks(const Imf::Header& header, const std::string& where, std::int64_t width, std::int64_t height,
                 std::int64_t channels) {
  constexpr std::int64_t kSmallTile = 1 << 24, kSmallRows = 1 << 26;  // values; whatever the image
  const bool isTiled = header.hasTileDescription();
  const std::int64_t pixels = isTiled ? std::int64_t{header.tileDescription().xSize} * header.tileDescription().ySize
                                      : width * rowsOfABlock(header.compression());
  const std::int64_t small = (isTiled ? kSmallTile : kSmallRows) / std::max<std::int64_t>(channels, 1);
  if (pixels <= std::max(small, width * height)) return;
  throw SceneError(isTiled ? "tiles are larger than the image" : "rows are too long for the image", where,
                   "check that the file is whole");
}

bool isSubsampled(const Imf::Header& header) {
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1) return true;
  }
  return false;
}

/// Y with RY and BY: what RgbaInputFile turns into RGB.
bool isLuminanceChroma(const Imf::Header& header) {
  const Imf::ChannelList& channels = header.channels();
  return channels.findChannel("Y") != nullptr && channels.findChannel("RY") != nullptr &&
         channels.findChannel("BY") != nullptr;
}

/// Checks the size of a part of a file of `fileBytes`, with its channels beside those there are already: before memory
/// is taken for it.
void checkSize(const Imf::Header& header, const std::string& where, std::size_t channelsBefore,
               std::int64_t fileBytes) {
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  std::int64_t own = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) ++own;
  const std::int64_t channels = static_cast<std::int64_t>(channelsBefore) + own;
  if (channels == 0) throw SceneError("the image has no channels", where, "give an image with R, G and B");
  if (width > kMostValues || height > kMostValues || width * height > kMostValues / channels) {
    throw SceneError(fmt::format("an image of {} x {} pixels with {} channels is too large", width, height, channels),
                     where, "scale it down, or check that the file is whole");
  }
  const Density most = mostPerByte(header.compression());
  if (width * height / most.pixels > fileBytes || width * height * own / most.values > fileBytes)
    throw SceneError(fmt::format("a file of {} bytes cannot hold {} x {} pixels", fileBytes, width, height), where,
                     "check that the file is whole");
  checkBlocks(header, where, width, height, own);
}

/// Nothing where the data window is the display window.
WholeImage wholeOf(const Imf::Header& header) {
  const Imath::Box2i &data = header.dataWindow(), &display = header.displayWindow();
  if (data == display) return {};
  // Differences of what a damaged header may claim wrap around.
  const auto difference = [](int a, int b) {
    return static_cast<int>(static_cast<unsigned>(a) - static_cast<unsigned>(b));
  };
  const int width = difference(display.max.x, display.min.x), height = difference(display.max.y, display.min.y);
  if (width < 0 || height < 0 || width >= kMostValues || height >= kMostValues) return {};
  return {width + 1, height + 1, difference(data.min.x, display.min.x), difference(data.min.y, display.min.y)};
}

void readAttributes(const Imf::Header& header, Image& image) {
  for (auto i = header.begin(); i != header.end(); ++i) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
    if (text != nullptr) image.attributes[i.name()] = text->value();
    const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&i.attribute());
    if (matrix != nullptr) std::copy_n(matrix->value().getValue(), 16, image.matrices[i.name()].begin());
  }
}

/// Adds the channels of a part, each with `prefix` before its name.
void readPart(Imf::MultiPartInputFile& exr, int part, const std::string& prefix, Image& image) {
  const Imf::Header& header = exr.header(part);
  const Imath::Box2i& window = header.dataWindow();
  const auto width = static_cast<std::size_t>(image.width);
  Imf::FrameBuffer frameBuffer;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    image.channels.push_back({prefix + i.name(), std::vector<float>(width * static_cast<std::size_t>(image.height))});
    float* values = image.channels.back().values.data();
    frameBuffer.insert(i.name(), Imf::Slice::Make(Imf::FLOAT, values, window, sizeof(float), sizeof(float) * width));
  }
  Imf::InputPart input(exr, part);
  input.setFrameBuffer(frameBuffer);
  input.readPixels(window.min.y, window.max.y);
}

/// Luminance with subsampled chroma, as RGB.
void readLuminanceChroma(const std::filesystem::path& file, Image& image) {
  Imf::RgbaInputFile exr(file.c_str());
  const Imath::Box2i window = exr.dataWindow();
  const auto width = static_cast<std::size_t>(image.width), pixels = width * static_cast<std::size_t>(image.height);
  std::vector<Imf::Rgba> row(width);
  for (const char* name : {"B", "G", "R"}) image.channels.push_back({name, {}});
  for (Channel& channel : image.channels) channel.values.reserve(pixels);
  for (int y = window.min.y; y <= window.max.y; ++y) {
    exr.setFrameBuffer(row.data() - window.min.x, 1, 0);
    exr.readPixels(y);
    for (const Imf::Rgba& value : row) {
      image.channels[0].values.push_back(value.b);
      image.channels[1].values.push_back(value.g);
      image.channels[2].values.push_back(value.r);
    }
  }
}

/// Parts after the first are layers: their names go before their channels', unless they begin with them.
std::string prefixOf(const Imf::Header& header) {
  if (!header.hasName()) return "";
  std::string prefix = header.name() + ".";
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    if (std::string(i.name()).starts_with(prefix)) return "";
  }
  return prefix;
}

Image readImage(const std::filesystem::path& file, const std::string& where) {
  checkExrHeader(file, where);
  Imf::MultiPartInputFile exr(file.c_str());
  const auto fileBytes = static_cast<std::int64_t>(std::filesystem::file_size(file));
  Image image;
  for (int part = 0; part < exr.parts(); ++part) {
    const Imf::Header& header = exr.header(part);
    const bool isDeep = header.hasType() && (header.type() == Imf::DEEPSCANLINE || header.type() == Imf::DEEPTILE);
    if (isDeep && part == 0) throw SceneError("this is a deep image", where, "flatten it first");
    if (isDeep) continue;
    checkSize(header, where, image.channels.size(), fileBytes);
    const Imath::Box2i& window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    if (part == 0) {
      image.width = width;
      image.height = height;
      image.whole = wholeOf(header);
      readAttributes(header, image);
    } else if (width != image.width || height != image.height || isSubsampled(header)) {
      continue;  // another view or a proxy: no layer of this image
    }
    if (!isSubsampled(header)) {
      readPart(exr, part, part == 0 ? "" : prefixOf(header), image);
    } else if (isLuminanceChroma(header)) {
      readLuminanceChroma(file, image);
    } else {
      throw SceneError("a channel is subsampled", where, "convert the image to RGB");
    }
  }
  return image;
}

}  // namespace

Image readExr(const std::filesystem::path& file) {
  const std::string where = file.string();
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw SceneError("no such file", where, "check the name");
  }
  if (std::filesystem::is_directory(file, error)) {
    throw SceneError("this is a folder", where, "give an OpenEXR file");
  }
  try {
    return readImage(file, where);
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception& failure) {
    throw SceneError(fmt::format("cannot read OpenEXR: {}", failure.what()), where,
                     "check that it is a whole OpenEXR file of plain pixels");
  }
}

}  // namespace importon
