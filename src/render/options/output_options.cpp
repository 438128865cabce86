#include "render/options/output_options.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/picture_file.h"
#include "render/options/aov_table.h"

namespace importon {
namespace {

using namespace option_rows;
using Group = OptionGroup;

/// The names of all layers, six lines of them at most.
std::string layerHelp() {
  std::string help = "extra layers, comma separated (default: none), of\n", line;
  for (const std::string& name : aovNames()) {
    if (line.size() + name.size() > 64) help += std::exchange(line, "") + "\n";
    line += (line.empty() ? "" : " ") + name;
  }
  return help + line;
}

OptionRow layers() {
  return {"--aov",
          "LIST",
          layerHelp(),
          Group::output,
          {},
          [](RenderJob& job, const std::string& list) { job.aovs = splitNames(list, aovNames(), "--aov"); },
          [](const RenderJob& job) { return fmt::format("{}", job.aovs.size()); }};
}

/// Told apart from the text "auto", and within what exp2 of a float holds.
std::string exposureFault(const std::string& given) {
  constexpr double kMost = 100;
  if (given == "auto") return {};
  if (finite("EV")(given).empty() && std::abs(numberOf<double>(given)) <= kMost) return {};
  return fmt::format("\"{}\" is neither auto nor a number from -{} to {} EV", given, kMost, kMost);
}

OptionRow exposure() {
  return {"--exposure",
          "EV,auto",
          "of PNG and JPEG: light counts 2^EV times, or as much as makes its\nlog-average middle grey (default: auto)",
          Group::output,
          exposureFault,
          [](RenderJob& job, const std::string& given) {
            if (given == "auto")
              job.look.exposure.reset();
            else
              job.look.exposure = numberOf<double>(given);
          },
          [](const RenderJob& job) { return textOf(job.look.exposure); }};
}

OptionRow toneMap() {
  static const std::map<std::string, ToneMap> kNames{
      {"neutral", ToneMap::neutral}, {"agx", ToneMap::agx}, {"aces", ToneMap::aces}, {"none", ToneMap::none}};
  return {"--tone-map",
          "neutral,agx,aces,none",
          "of PNG and JPEG: Khronos PBR Neutral, AgX, ACES, or values above 1\ncut off (default: neutral)",
          Group::output,
          oneOf({"neutral", "agx", "aces", "none"}),
          [](RenderJob& job, const std::string& given) { job.look.toneMap = kNames.at(given); },
          [](const RenderJob& job) {
            const auto isIt = [&](const auto& entry) { return entry.second == job.look.toneMap; };
            return std::ranges::find_if(kNames, isIt)->first;
          }};
}

OptionRow pngDepth() {
  return {"--png-depth",
          "8,16",
          "bits of a channel of a PNG (default: 8)",
          Group::output,
          oneOf({"8", "16"}),
          [](RenderJob& job, const std::string& given) { job.look.isDeep = given == "16"; },
          [](const RenderJob& job) { return std::string(job.look.isDeep ? "16" : "8"); }};
}

/// The kind of what --output names; OpenEXR where the name does not tell.
PictureKind kindOf(const RenderJob& job) {
  return pictureKind(job.output, PictureKind::exr).value_or(PictureKind::exr);
}

}  // namespace

std::vector<OptionRow> outputOptions() {
  constexpr OptionNeed kNeedsExr{.what = "an OpenEXR file, -o F.exr",
                                 .isMet = [](const RenderJob& job) { return kindOf(job) == PictureKind::exr; }};
  return {
      text(Group::output, "-o,--output", "F.exr", &RenderJob::output,
           "linear OpenEXR with a layer for each AOV; or F.hdr, F.png, F.jpg")
          .everyday()
          .required(),
      text(Group::output, "--png", "F.png", &RenderJob::png,
           "tone-mapped preview beside it, F.jpg a JPEG (default: none)")
          .everyday(),
      exposure(),
      toneMap(),
      pngDepth(),
      flag(Group::output, "--half", &RenderJob::hasHalfColors, "16-bit float for colours of OpenEXR (default: 32)")
          .needs(kNeedsExr),
      layers().needs(kNeedsExr),
      text(Group::output, "--reference", "REF.exr", &RenderJob::reference,
           "image to measure the error against after each pass, for\n--stats (default: none)"),
      text(Group::output, "--stats", "F.json", &RenderJob::stats, "counts, times and warnings as JSON (default: none)")
          .everyday()};
}

}  // namespace importon
