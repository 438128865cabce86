/// Images in memory, OpenEXR and Radiance in and out, PNG previews.
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace importon {

/// One plane of floats, row-major from the top, named as in OpenEXR ("R", "albedo.R", "depth.Z").
struct Channel {
  std::string name;
  std::vector<float> values;  // width * height
  bool isHalf = false;        // OpenEXR gets it as half floats
};

/// The whole image that an image is a part of, and where in it its upper left pixel is. Without a width: it is no part.
struct WholeImage {
  int width = 0, height = 0;  // pixels
  int x = 0, y = 0;
};

/// A matrix that row vectors are multiplied by from the left, by rows, as OpenEXR has them.
using ImageMatrix = std::array<float, 16>;

/// Planes of one size, and attributes.
struct Image {
  int width = 0, height = 0;
  std::vector<Channel> channels;
  std::map<std::string, std::string> attributes;
  WholeImage whole = {};  // OpenEXR's display window; the image is its data window
  std::map<std::string, ImageMatrix> matrices = {};
  [[nodiscard]] const Channel* find(const std::string& name) const;
};

/// Writes all channels as 32-bit or 16-bit float, ZIP-compressed scanlines, under a temporary name that is renamed at
/// the end. What 16 bits cannot hold becomes the greatest finite number that they can. Throws OutputError and leaves no
/// file then.
void writeExr(const std::filesystem::path& file, const Image& image);

/// Reads any scanline or tiled OpenEXR (half, float, uint; any compression; layers), of the size of its data
/// window; where the display window is another, Image::whole says so. Further parts of that size are layers:
/// "PART.CHANNEL". Luminance with subsampled chroma becomes RGB. Throws SceneError on a missing, malformed or deep
/// file.
[[nodiscard]] Image readExr(const std::filesystem::path& file);

/// Reads a Radiance picture (.hdr, .pic) of RGBE pixels, W/(m² sr) with its exposures undone: flat, or with run lengths
/// of the old or the new kind, in any orientation. Throws SceneError. [Ward, "Real Pixels", Graphics Gems II, 1991;
/// Radiance's reference, "Picture File Format"]
[[nodiscard]] Image readHdr(const std::filesystem::path& file);

/// The same from memory.
[[nodiscard]] Image decodeHdr(std::span<const unsigned char> bytes, const std::string& where);

/// Writes channels R, G and B as a Radiance picture with run lengths, renamed into place like writeExr. What is less
/// than nothing counts as nothing. Throws OutputError. [Ward, as above]
void writeHdr(const std::filesystem::path& file, const Image& image);

/// True if the file begins as a Radiance picture does.
[[nodiscard]] bool isHdr(const std::filesystem::path& file);

/// A tone-mapped 8-bit preview of channels R, G, B: exposure by the log-average luminance, the neutral
/// tone map, sRGB. Renamed into place like writeExr.
void writePng(const std::filesystem::path& file, const Image& image);

/// Throws OutputError if `file` cannot be created (folder missing, no permission), without leaving a trace:
/// asked before a long render starts.
void checkWritable(const std::filesystem::path& file);

}  // namespace importon
