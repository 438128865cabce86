/// Images in memory, OpenEXR in and out, PNG previews.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace importon {

/// One plane of floats, row-major from the top, named as in OpenEXR ("R", "albedo.R", "depth.Z").
struct Channel {
  std::string name;
  std::vector<float> values;  // width * height
};

/// Planes of one size, and string attributes.
struct Image {
  int width = 0, height = 0;
  std::vector<Channel> channels;
  std::map<std::string, std::string> attributes;
  [[nodiscard]] const Channel* find(const std::string& name) const;
};

/// Writes all channels as 32-bit float, ZIP-compressed scanlines, under a temporary name that is renamed at the
/// end. Throws OutputError and leaves no file then.
void writeExr(const std::filesystem::path& file, const Image& image);

/// Reads any scanline or tiled OpenEXR (half, float, uint; any compression; layers), of the size of its data
/// window. Further parts of that size are layers: "PART.CHANNEL". Luminance with subsampled chroma becomes RGB.
/// Throws SceneError on a missing, malformed or deep file.
[[nodiscard]] Image readExr(const std::filesystem::path& file);

/// A tone-mapped 8-bit preview of channels R, G, B: exposure by the log-average luminance, a filmic shoulder,
/// sRGB. Renamed into place like writeExr.
void writePng(const std::filesystem::path& file, const Image& image);

/// Throws OutputError if `file` cannot be created (folder missing, no permission), without leaving a trace:
/// asked before a long render starts.
void checkWritable(const std::filesystem::path& file);

}  // namespace importon
