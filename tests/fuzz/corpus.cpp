/// Writes the first inputs of the fuzzers: importon_fuzz_corpus FOLDER, which has a
/// folder for each.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfTiledOutputFile.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "loader/everything.h"
#include "loader/image_builder.h"
#include "loader/pack_builder.h"

namespace {

using importon::test::Bytes;
using namespace std::string_literals;

void write(const std::filesystem::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// A tiny image of three channels with this compression.
void writeExr(const std::filesystem::path& file, Imf::Compression compression, bool isTiled) {
  constexpr int kWidth = 9, kHeight = 5;
  Imf::Header header(kWidth, kHeight);
  header.compression() = compression;
  std::vector<float> values(kWidth * kHeight, 0.75F);
  Imf::FrameBuffer frameBuffer;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frameBuffer.insert(
        name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * kWidth));
  }
  if (isTiled) {
    header.setTileDescription(Imf::TileDescription(4, 4, Imf::MIPMAP_LEVELS));
    Imf::TiledOutputFile exr(file.c_str(), header);
    exr.setFrameBuffer(frameBuffer);
    exr.writeTiles(0, exr.numXTiles() - 1, 0, exr.numYTiles() - 1);
  } else {
    Imf::OutputFile exr(file.c_str(), header);
    exr.setFrameBuffer(frameBuffer);
    exr.writePixels(kHeight);
  }
}

void writeLuminanceChroma(const std::filesystem::path& file) {
  constexpr int kSide = 8;
  const std::vector<Imf::Rgba> pixels(kSide * kSide, Imf::Rgba(0.75F, 0.5F, 0.25F, 1.F));
  Imf::RgbaOutputFile exr(file.c_str(), kSide, kSide, Imf::WRITE_YC);
  exr.setFrameBuffer(pixels.data(), 1, kSide);
  exr.writePixels(kSide);
}

/// Radiance pictures of each kind of run lengths.
void writeHdrs(const std::filesystem::path& folder) {
  const std::string header = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 10\n";
  const std::string newRuns = "\x02\x02\x00\x0a\x8a\x05\x03\x01\x02\x03\x87\x09\x8a\x01\x8a\x88"s;
  const std::string oldRuns = "\x09\x08\x07\x88\x01\x01\x01\x08\x03\x03\x03\x88"s;
  for (const auto& [name, pixels] : {std::pair("new.hdr", newRuns), std::pair("old.hdr", oldRuns)}) {
    const std::string file = header + pixels;
    write(folder / name, Bytes(file.begin(), file.end()));
  }
}

void writeImages(const std::filesystem::path& folder) {
  using namespace importon::test;
  const Bytes rgb(192, 100);
  write(folder / "rgba.png", makePng(4, 4, Bytes(64, 100)));
  write(folder / "deep.png", makePng({.width = 2, .bitDepth = 16, .colorType = 2}, Bytes(12, 100)));
  write(folder / "palette.png",
        makePng({.width = 2, .colorType = 3, .palette = {1, 2, 3, 4, 5, 6}, .transparency = {7}}, {0, 1}));
  write(folder / "interlaced.png", makeInterlacedPng(9, 9, Bytes(81, 100)));
  write(folder / "baseline.jpg", makeJpeg(8, 8, rgb));
  write(folder / "progressive.jpg", makeJpeg(8, 8, rgb, JpegKind::progressive));
  write(folder / "arithmetic.jpg", makeJpeg(8, 8, rgb, JpegKind::arithmetic));
  write(folder / "inks.jpg", makeJpeg(8, 6, rgb, JpegKind::inks));
  write(folder / "adobe.jpg", makeJpeg(8, 6, rgb, JpegKind::adobeInks));
  write(folder / "lossless.webp", makeWebp(4, 4, Bytes(64, 100)));
  write(folder / "lossy.webp", makeWebp(4, 4, Bytes(64, 100), false));
  write(folder / "eight.avif", makeAvif(8, {200, 100, 50, 255}));
  write(folder / "ten.avif", makeAvif(8, {1000, 500, 250, 600}, 10));
}

/// Behind the three bytes that geometry_fuzzer.cpp wants.
void writeGeometry(const std::filesystem::path& folder) {
  using namespace importon::test;
  const auto writeWith = [&](const char* name, Bytes head, const Bytes& stream) {
    head.insert(head.end(), stream.begin(), stream.end());
    write(folder / name, head);
  };
  const PlainMesh mesh{.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
                       .uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}},
                       .indices = {0, 1, 2, 2, 1, 3}};
  writeWith("sequential", {0, 4, 2}, encodeDraco(mesh, DracoMethod::sequential));
  writeWith("edgebreaker", {0, 4, 2}, encodeDraco(mesh, DracoMethod::edgebreaker));
  const std::uint32_t values[] = {0, 1, 2, 2, 1, 3};
  const char* modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
  for (unsigned char mode = 0; mode < 3; ++mode) {
    GltfBuilder builder;
    addMeshoptView(builder, values, 6, 4, modes[mode]);
    for (unsigned char filter = 0; filter < 4; ++filter) {
      const unsigned char kind = static_cast<unsigned char>(1 + mode + 3 * filter);
      writeWith(("meshopt" + std::to_string(kind)).c_str(), {kind, 6, 4}, builder.binary);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const std::filesystem::path folder = argv[1], gltf = folder / "loader", exr = folder / "exr";
  write(gltf / "everything.glb", importon::test::everything().glb());
  write(gltf / "animated.glb", importon::test::animatedFile().glb());
  write(gltf / "profile.glb", importon::test::profileFile().glb());
  write(gltf / "everything.gltf", importon::test::everything().gltf());
  write(gltf / "packed.glb", importon::test::packedFile().glb());
  writeImages(folder / "image");
  writeGeometry(folder / "geometry");
  write(gltf / "triangle.gltf", importon::test::GltfBuilder::emissiveTriangle().gltf());
  for (int i = 0; i < Imf::NUM_COMPRESSION_METHODS; ++i)
    for (const bool isTiled : {false, true})
      writeExr(exr / (std::to_string(i) + (isTiled ? "t.exr" : "s.exr")), static_cast<Imf::Compression>(i), isTiled);
  writeLuminanceChroma(exr / "yc.exr");
  writeHdrs(folder / "hdr");
  return 0;
}
