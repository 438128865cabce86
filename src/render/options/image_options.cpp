#include "render/options/image_options.h"

#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "scene/scene.h"

namespace importon {
namespace {

using namespace option_rows;
using Group = OptionGroup;

constexpr std::int64_t kMostPixelsWide = 65536;

ValueCheck fStops() {
  return [](const std::string& given) {
    if (positive("")(given).empty() && numberOf<double>(given) >= Camera::kLeastFStop) return std::string();
    return fmt::format("\"{}\" is not a number from {} on", given, Camera::kLeastFStop);
  };
}

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

/// Four whole numbers with a space between each two, as the words of one value are joined.
std::optional<Crop> cropOf(const std::string& text) {
  Crop crop;
  const char *at = text.data(), *end = at + text.size();
  for (int* const number : {&crop.x, &crop.y, &crop.width, &crop.height}) {
    if (number != &crop.x && at != end) ++at;
    const auto read = std::from_chars(at, end, *number);
    const bool isSize = number == &crop.width || number == &crop.height;
    if (read.ec != std::errc() || *number < (isSize ? 1 : 0) || *number > kMostPixelsWide) return std::nullopt;
    if (read.ptr != end && *read.ptr != ' ') return std::nullopt;
    at = read.ptr;
  }
  return at == end ? std::optional(crop) : std::nullopt;
}

OptionRow crop() {
  OptionRow row{"--crop",
                "X Y W H",
                "only W x H pixels of the image from column X and row Y on, from\nthe upper left; importance comes "
                "from there alone (default: all)",
                Group::image,
                [](const std::string& given) {
                  if (cropOf(given)) return std::string();
                  return fmt::format("\"{}\" are not four whole numbers of up to {}, X and Y from 0, W and H from 1",
                                     given, kMostPixelsWide);
                },
                [](RenderJob& job, const std::string& given) { job.crop = cropOf(given); },
                [](const RenderJob& job) {
                  if (!job.crop) return std::string("all");
                  return fmt::format("{} {} {} {}", job.crop->x, job.crop->y, job.crop->width, job.crop->height);
                }};
  row.words = 4;
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
      crop(),
      name("--camera", "camera by its name, its node's or index, or all (default: the first)", &RenderJob::camera)
          .everyday(),
      number(Group::image, "--f-stop", "N", &RenderJob::fStop, fStops(),
             "a thin lens: focal length, of a film 24 mm high, over the lens's\ndiameter (default: the camera's "
             "extras.fStop, else a pinhole)")
          .forImage(),
      number(Group::image, "--focus", "M", &RenderJob::focus, positive("m"),
             "distance in focus, along the view, m (default: the camera's\nextras.focusDistance)")
          .forImage(),
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
