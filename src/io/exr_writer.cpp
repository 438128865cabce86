#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <cassert>
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
  for (const Channel& channel : image.channels) header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
  return header;
}

Imf::FrameBuffer makeFrameBuffer(const Image& image) {
  Imf::FrameBuffer frameBuffer;
  const std::size_t rowBytes = sizeof(float) * static_cast<std::size_t>(image.width);
  const Imath::Box2i window = dataWindow(image);
  for (const Channel& channel : image.channels) {
    assert(channel.values.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
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
    exr.setFrameBuffer(makeFrameBuffer(image));
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
