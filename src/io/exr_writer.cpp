#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <exception>

#include "base/error.h"
#include "io/image.h"
#include "io/output_file.h"

namespace importon {
namespace {

/// Lets OpenEXR write to an OutputFile. Its destructors swallow what is thrown while the last table is written,
/// so the first failure is kept here for the caller.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(OutputFile& file, const char* name) : OStream(name), file_(file) {}
  void write(const char bytes[], int count) override {
    guarded([&] { file_.write(std::as_bytes(std::span(bytes, static_cast<std::size_t>(count)))); });
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override {
    guarded([&] { file_.seek(position); });
  }
  void rethrowFailure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  template <class Action>
  void guarded(const Action& action) {
    try {
      action();
    } catch (...) {
      if (!failure_) failure_ = std::current_exception();
      throw;
    }
  }
  OutputFile& file_;
  std::exception_ptr failure_;
};

/// From the display window's upper left corner.
Imath::Box2i dataWindow(const Image& image) {
  const Imath::V2i corner(image.whole.x, image.whole.y);
  return {corner, corner + Imath::V2i(image.width - 1, image.height - 1)};
}

Imf::Header makeHeader(const Image& image) {
  const bool isPart = image.whole.width > 0;
  Imf::Header header(isPart ? image.whole.width : image.width, isPart ? image.whole.height : image.height);
  header.dataWindow() = dataWindow(image);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default: Rec. ITU-R BT.709, white D65
  for (const auto& [name, value] : image.attributes) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : image.matrices) {
    Imath::M44f matrix;
    std::ranges::copy(value, matrix.getValue());
    header.insert(name, Imf::M44fAttribute(matrix));
  }
  for (const Channel& channel : image.channels)
    header.channels().insert(channel.name, Imf::Channel(channel.isHalf ? Imf::HALF : Imf::FLOAT));
  return header;
}

/// The nearest half floats. Light beyond their range stays finite: no infinity of ours is to spoil what is made of it.
std::vector<half> halvesOf(std::span<const float> values) {
  constexpr float kMost = 65504;
  std::vector<half> halves;
  halves.reserve(values.size());
  for (const float value : values) halves.emplace_back(std::isfinite(value) ? std::clamp(value, -kMost, kMost) : value);
  return halves;
}

/// `halves` holds what channels of half floats are written from.
Imf::FrameBuffer makeFrameBuffer(const Image& image, std::deque<std::vector<half>>& halves) {
  Imf::FrameBuffer frameBuffer;
  const std::size_t rowBytes = sizeof(float) * static_cast<std::size_t>(image.width);
  const Imath::Box2i window = dataWindow(image);
  for (const Channel& channel : image.channels) {
    assert(channel.values.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    if (channel.isHalf) {
      const half* own = halves.emplace_back(halvesOf(channel.values)).data();
      frameBuffer.insert(channel.name, Imf::Slice::Make(Imf::HALF, own, window, sizeof(half), rowBytes / 2));
      continue;
    }
    const float* values = channel.values.data();
    frameBuffer.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, values, window, sizeof(float), rowBytes));
  }
  return frameBuffer;
}

}  // namespace

void writeExr(const std::filesystem::path& file, const Image& image) {
  OutputFile output(file);
  ExrStream stream(output, file.c_str());
  try {
    Imf::OutputFile exr(stream, makeHeader(image));
    std::deque<std::vector<half>> halves;
    exr.setFrameBuffer(makeFrameBuffer(image, halves));
    exr.writePixels(image.height);
  } catch (const std::exception& error) {
    stream.rethrowFailure();
    throw OutputError(std::string("cannot write OpenEXR: ") + error.what(), file.string(),
                      "check the image size and layer names");
  }
  stream.rethrowFailure();
  output.commit();
}

}  // namespace importon
