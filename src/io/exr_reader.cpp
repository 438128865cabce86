#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <exception>
#include <system_error>

#include "base/error.h"
#include "fmt/format.h"
#include "io/image.h"

namespace importon {
namespace {

// A damaged header may claim any size; 2^30 values are 4 GiB.
constexpr std::int64_t kMostValues = std::int64_t{1} << 30;

void readHeader(const Imf::Header& header, const std::string& where, Image& image) {
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  std::int64_t channels = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1) {
      throw SceneError(fmt::format("channel {} is subsampled", i.name()), where, "convert the image to RGB");
    }
    ++channels;
  }
  if (channels == 0) throw SceneError("the image has no channels", where, "give an image with R, G and B");
  if (width > kMostValues || height > kMostValues || width * height > kMostValues / channels) {
    throw SceneError(
        fmt::format("an image of {} x {} pixels with {} channels is too large", width, height, channels), where,
        "scale it down, or check that the file is whole");
  }
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  for (auto i = header.begin(); i != header.end(); ++i) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
    if (text != nullptr) image.attributes[i.name()] = text->value();
  }
}

void readPixels(Imf::InputFile& exr, Image& image) {
  const Imath::Box2i window = exr.header().dataWindow();
  const auto width = static_cast<std::size_t>(image.width);
  const auto pixels = width * static_cast<std::size_t>(image.height);
  Imf::FrameBuffer frameBuffer;
  for (auto i = exr.header().channels().begin(); i != exr.header().channels().end(); ++i) {
    image.channels.push_back({i.name(), std::vector<float>(pixels)});
    float* values = image.channels.back().values.data();
    frameBuffer.insert(i.name(),
                       Imf::Slice::Make(Imf::FLOAT, values, window, sizeof(float), sizeof(float) * width));
  }
  exr.setFrameBuffer(frameBuffer);
  exr.readPixels(window.min.y, window.max.y);
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
  Image image;
  try {
    Imf::InputFile exr(file.c_str());
    readHeader(exr.header(), where, image);
    readPixels(exr, image);
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception& failure) {
    throw SceneError(fmt::format("cannot read OpenEXR: {}", failure.what()), where,
                     "check that it is a whole OpenEXR file of plain pixels");
  }
  return image;
}

}  // namespace importon
