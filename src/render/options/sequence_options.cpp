#include "render/options/sequence_options.h"

namespace importon {
namespace {

using namespace option_rows;
using Group = OptionGroup;

constexpr std::int64_t kLastFrame = 9'999'999, kMostFrames = 100'000;

/// "A..B"; none: it is something else.
std::optional<FrameRange> rangeOf(const std::string& text) {
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) return std::nullopt;
  const std::string first = text.substr(0, dots), last = text.substr(dots + 2);
  const ValueCheck isFrame = wholeNumber(0, kLastFrame, "");
  if (!isFrame(first).empty() || !isFrame(last).empty()) return std::nullopt;
  return FrameRange{numberOf<std::int64_t>(first), numberOf<std::int64_t>(last)};
}

std::string rangeFault(const std::string& text) {
  const std::optional<FrameRange> range = rangeOf(text);
  if (!range) return fmt::format("\"{}\" is not A..B, two whole numbers from 0 to {}", text, kLastFrame);
  if (range->first > range->last) return fmt::format("\"{}\" ends before it begins", text);
  if (range->last - range->first >= kMostFrames)
    return fmt::format("\"{}\" has more than {} frames", text, kMostFrames);
  return {};
}

OptionRow frames() {
  return {"--frames",
          "A..B",
          "frames of the animations, at 24 a second or --fps (-o F.%04d.exr)",
          Group::image,
          rangeFault,
          [](RenderJob& job, const std::string& given) { job.frames = rangeOf(given); },
          [](const RenderJob& job) {
            return job.frames ? fmt::format("{}..{}", job.frames->first, job.frames->last) : std::string("none");
          }};
}

constexpr OptionNeed kNeedsSequence{.what = "--frames or --turntable",
                                    .isMet = [](const RenderJob& job) { return isSequence(job); }};

}  // namespace

bool isSequence(const RenderJob& job) { return job.frames || job.turntable; }

std::vector<OptionRow> sequenceOptions() {
  return {frames().everyday().needs({.what = "no time of its own, --at",
                                     .advice = "leave one of them out",
                                     .isMet = [](const RenderJob& job) { return !job.at; }}),
          number(Group::image, "--fps", "N", &RenderJob::framesPerSecond, positive("frames a second"),
                 "frames a second: frame F shows the time F/N (default: 24)")
              .needs({.what = "--frames", .isMet = [](const RenderJob& job) { return job.frames.has_value(); }}),
          number(Group::image, "--turntable", "N", &RenderJob::turntable, wholeNumber(1, kMostFrames, "frames"),
                 "the camera goes once around the scene in N frames, into\n-o NAME.%04d.exr (default: it stays)"),
          flag(Group::image, "--seed-per-frame", &RenderJob::hasSeedPerFrame,
               "frame F has the seed --seed + F (default: the same for all)")
              .needs(kNeedsSequence),
          flag(Group::image, "--skip-existing", &RenderJob::skipsMadeFrames,
               "leave frames alone whose files are there: goes on where it\nstopped (default: makes them anew)")
              .needs(kNeedsSequence)};
}

}  // namespace importon
