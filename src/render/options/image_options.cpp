#include "render/options/image_options.h"

#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

namespace importon {
namespace {

using namespace option_rows;
using Group = OptionGroup;

constexpr std::int64_t kMostPixelsWide = 65536;

/// Three numbers of 0 or more, "R,G,B".
std::optional<std::array<float, 3>> colorOf(const std::string& text) {
  std::array<float, 3> color{};
  const char *at = text.data(), *end = at + text.size();
  for (std::size_t c = 0; c < color.size(); ++c) {
    const auto read = std::from_chars(at, end, color[c]);
    if (read.ec != std::errc() || !(color[c] >= 0) || !std::isfinite(color[c])) return std::nullopt;
    const bool isLast = c + 1 == color.size();
    if (isLast ? read.ptr != end : read.ptr == end || *read.ptr != ',') return std::nullopt;
    at = isLast ? end : read.ptr + 1;
  }
  return color;
}

OptionRow background() {
  OptionRow row{"--background",
                "R,G,B|transparent",
                "radiance seen where nothing is hit, which lights nothing; or\ncoverage as alpha "
                "(default: the environment)",
                Group::image,
                [](const std::string& given) {
                  return given == "transparent" || colorOf(given)
                             ? std::string()
                             : "\"" + given + "\" is neither transparent nor three numbers of 0 or more, R,G,B";
                },
                [](RenderJob& job, const std::string& given) {
                  if (given == "transparent")
                    job.isTransparent = true;
                  else
                    job.background = colorOf(given);
                },
                [](const RenderJob& job) {
                  if (job.isTransparent) return std::string("transparent");
                  return job.background ? fmt::format("{}", fmt::join(*job.background, ",")) : "environment";
                }};
  return std::move(row).forImage();
}

OptionRow name(const char* option, const char* help, std::string RenderJob::*member) {
  return {option,
          "NAME",
          help,
          Group::image,
          {},
          [member](RenderJob& job, const std::string& given) { job.*member = given; },
          [member](const RenderJob& job) { return job.*member; }};
}

}  // namespace

std::vector<OptionRow> imageOptions() {
  const auto pixels = wholeNumber(1, kMostPixelsWide, "pixels");
  return {
      number(Group::image, "--width", "PIXELS", &RenderJob::width, pixels,
             "width of the image (default: the camera's extras.width, else 640)")
          .everyday(),
      number(Group::image, "--height", "PIXELS", &RenderJob::height, pixels,
             "height of the image (default: by the camera's aspect ratio)")
          .everyday(),
      name("--camera", "camera by its name, its node's or index, or all (default: the first)", &RenderJob::camera)
          .everyday(),
      name("--scene", "which scene of the file, by name or index (default: the file's\nchoice)", &RenderJob::sceneName),
      name("--variant", "which variant of the materials, by name or index (default: none)", &RenderJob::variant),
      number(Group::image, "--at", "SECONDS", &RenderJob::at, notNegative("seconds"),
             "pose of the animations at that time (default: the pose at rest)"),
      name("--animation", "which animation plays, by name or index (default: all at once)", &RenderJob::animation)
          .needs(
              {.what = "a time, --at or --frames", .isMet = [](const RenderJob& job) { return job.at || job.frames; }}),
      choice<PixelFilter>(Group::image, "--filter", &RenderJob::filter,
                          {{"box", PixelFilter::box},
                           {"gaussian", PixelFilter::gaussian},
                           {"blackman-harris", PixelFilter::blackmanHarris}},
                          "pixel filter (default: box)")
          .forImage(),
      background(),
      flag(Group::image, "--transparent", &RenderJob::isTransparent,
           "--background transparent: coverage as alpha (default: none)")
          .everyday()
          .needs({.what = "a transparent background, not one of a colour",
                  .advice = "leave out --transparent or --background",
                  .isMet = [](const RenderJob& job) { return !job.background; }}),
      choice<LightChoice>(
          Group::image, "--light", &RenderJob::light,
          {{"auto", LightChoice::automatic}, {"scene", LightChoice::scene}, {"studio", LightChoice::studio}},
          "a studio lights what has no light, nothing, or all (default: auto)")
          .everyday(),
      text(Group::image, "--environment", "F", &RenderJob::environment,
           "lat-long environment map, .exr or .hdr; its middle looks along\n-z, its top is +y (default: the scene's)")
          .everyday()
          .needs({.what = "the light of the scene, which --light studio takes away",
                  .advice = "leave one of them out",
                  .isMet = [](const RenderJob& job) { return job.light != LightChoice::studio; }}),
      number(Group::image, "--environment-rotation", "DEGREES", &RenderJob::environmentRotation, finite("degrees"),
             "turns the environment about +y, counter-clockwise from above")};
}

}  // namespace importon
