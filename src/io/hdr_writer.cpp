#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "fmt/format.h"
#include "io/image.h"
#include "io/output_file.h"
#include "io/tone_map.h"

namespace importon {
namespace {

using Pixel = std::array<std::uint8_t, 4>;  // red, green, blue, exponent

/// The nearest that there is; less than nothing and NaN count as nothing, what is too bright as the brightest.
Pixel pixelOf(const std::array<float, 3>& light) {
  constexpr int kBias = 128, kMostExponent = 255;
  std::array<double, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = light[c] > 0 ? static_cast<double>(light[c]) : 0.0;
  const double most = *std::ranges::max_element(rgb);
  if (std::isinf(most)) return {255, 255, 255, kMostExponent};
  int exponent = 0;
  (void)std::frexp(most, &exponent);
  if (most > 0 && std::lround(std::ldexp(most, 8 - exponent)) > 255) ++exponent;
  if (most == 0 || exponent + kBias <= 0) return {0, 0, 0, 0};
  Pixel pixel{0, 0, 0, static_cast<std::uint8_t>(std::min(exponent + kBias, kMostExponent))};
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>(std::min(std::lround(std::ldexp(rgb[c], 8 - exponent)), 255L));
  return pixel;
}

/// One component of a line, with run lengths of the new kind. [Radiance's color.c, fwritecolrs]
void pack(std::span<const Pixel> line, std::size_t part, std::vector<std::uint8_t>& out) {
  constexpr std::size_t kLeastRun = 4, kMostRun = 127, kMostPlain = 128;
  const auto runAt = [&](std::size_t from) {
    std::size_t end = from + 1;
    while (end < line.size() && end - from < kMostRun && line[end][part] == line[from][part]) ++end;
    return end - from;
  };
  for (std::size_t at = 0; at < line.size();) {
    std::size_t plain = 0;
    while (at + plain < line.size() && plain < kMostPlain && runAt(at + plain) < kLeastRun) ++plain;
    if (plain > 0) {
      out.push_back(static_cast<std::uint8_t>(plain));
      for (std::size_t i = 0; i < plain; ++i) out.push_back(line[at + i][part]);
      at += plain;
      continue;
    }
    const std::size_t run = runAt(at);
    out.push_back(static_cast<std::uint8_t>(kMostPlain + run));
    out.push_back(line[at][part]);
    at += run;
  }
}

void packLine(std::span<const Pixel> line, std::vector<std::uint8_t>& out) {
  constexpr std::size_t kLeastPacked = 8, kMostPacked = 0x7FFF;
  if (line.size() < kLeastPacked || line.size() > kMostPacked) {
    for (const Pixel& pixel : line) out.insert(out.end(), pixel.begin(), pixel.end());
    return;
  }
  for (const std::size_t byte : {std::size_t{2}, std::size_t{2}, line.size() >> 8, line.size() & 255u})
    out.push_back(static_cast<std::uint8_t>(byte));
  for (std::size_t part = 0; part < 4; ++part) pack(line, part, out);
}

}  // namespace

void writeHdr(const std::filesystem::path& file, const Image& image) {
  OutputFile output(file);
  const auto rgb = rgbOf(image, file.string());
  const std::string header = fmt::format(
      "#?RADIANCE\nSOFTWARE=importon\nFORMAT=32-bit_rle_rgbe\n"
      "PRIMARIES=0.6400 0.3300 0.3000 0.6000 0.1500 0.0600 0.3127 0.3290\n\n-Y {} +X {}\n",
      image.height, image.width);
  output.write(std::as_bytes(std::span(header)));
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<Pixel> line(width);
  std::vector<std::uint8_t> packed;
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      line[x] = pixelOf({rgb[0][i], rgb[1][i], rgb[2][i]});
    }
    packed.clear();
    packLine(line, packed);
    output.write(std::as_bytes(std::span(packed)));
  }
  output.commit();
}

}  // namespace importon
