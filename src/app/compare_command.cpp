#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "fmt/format.h"
#include "io/image.h"
#include "io/image_part.h"
#include "io/layers.h"
#include "report/compare.h"
#include "report/false_color.h"
#include "report/plain_surfaces.h"

namespace importon {
namespace {

constexpr double kPercent = 100;

/// What is seen on plain surfaces.
struct Cleanness {
  bool isPlainKnown = false;
  BandError band;
  double grain = 0;
};

Cleanness cleannessOf(const Image& whole, const Image& image, const Image& wholeReference, const Image& reference) {
  const PlainSurfaces plain = findPlainSurfaces(wholeReference, reference, whole, image);
  return {plain.isKnown, bandError(image, reference, plain), grainRatio(image, plain)};
}

std::string asText(const Comparison& result, const Cleanness& clean) {
  std::string text = fmt::format(
      "relmse          {:.6g}\nrelmse_trimmed  {:.6g}\nsmape           {:.6g}\nrmse            {:.6g}\n"
      "mean_ratio      {:.6g}\nflip            {:.6g} (LDR-FLIP, tone-mapped by the reference)\n"
      "flip_hdr        {:.6g} (HDR-FLIP)\n",
      result.relmse, result.relmseTrimmed, result.smape, result.rmse, result.meanRatio, result.flip, result.flipHdr);
  text += fmt::format(
      "band            {:.4g} % (RMS of ln(I/R) between 2 and 8 pixels; 95th percentile: {:.4g} %, 99th: {:.4g} %)\n"
      "grain           {:.4g} (99.5th over 25th percentile; {})\n",
      kPercent * clean.band.rms, kPercent * clean.band.p95, kPercent * clean.band.p99, clean.grain,
      clean.isPlainKnown ? "both on plain surfaces" : "both on all pixels: no layers N and P");
  if (result.nonFinitePixels > 0) text += fmt::format("non-finite pixels: {}\n", result.nonFinitePixels);
  return text;
}

/// What is infinite becomes null.
std::string asJson(const Comparison& result, const Cleanness& clean) {
  const nlohmann::ordered_json json{{"relmse", result.relmse},
                                    {"relmse_trimmed", result.relmseTrimmed},
                                    {"smape", result.smape},
                                    {"rmse", result.rmse},
                                    {"mean_ratio", result.meanRatio},
                                    {"flip", result.flip},
                                    {"flip_kind", "LDR-FLIP, tone-mapped by the reference"},
                                    {"flip_hdr", result.flipHdr},
                                    {"band_rms", kPercent * clean.band.rms},
                                    {"band_p95", kPercent * clean.band.p95},
                                    {"band_p99", kPercent * clean.band.p99},
                                    {"grain_ratio", clean.grain},
                                    {"on_plain_surfaces", clean.isPlainKnown},
                                    {"non_finite_pixels", result.nonFinitePixels}};
  return json.dump(2) + "\n";
}

}  // namespace

ExitStatus runCompare(const CompareCommand& command) {
  for (const std::filesystem::path& file : {command.diff, command.diffPng}) {
    if (!file.empty()) checkWritable(file);
  }
  const std::string imageName = command.image.string(), referenceName = command.reference.string();
  Image whole = readExr(command.image), wholeReference = readExr(command.reference);
  cutToShared(whole, wholeReference, imageName + ", " + referenceName);
  const Image image = takeColor(whole, command.layer, imageName);
  const Image reference = takeColor(wholeReference, command.referenceLayer, referenceName);
  ErrorMaps maps;
  const Comparison result = compareImages(image, imageName, reference, referenceName, command.floor, &maps);
  const Cleanness clean = cleannessOf(whole, image, wholeReference, reference);
  if (!command.diff.empty()) {
    writeExr(command.diff, differenceImage(image, imageName, reference, referenceName, maps));
  }
  if (!command.diffPng.empty()) writePng(command.diffPng, falseColors(image.width, image.height, maps.flip));
  std::fputs((command.isJson ? asJson(result, clean) : asText(result, clean)).c_str(), stdout);
  ExitStatus status = ExitStatus::ok;
  const auto hold = [&](const char* name, double value, std::optional<double> limit) {
    if (!limit || value <= *limit) return;
    std::fprintf(stderr, "importon: %s %g is above the limit %g\n", name, value, *limit);
    status = ExitStatus::limitExceeded;
  };
  hold("relmse", result.relmse, command.maxRelmse);
  hold("flip", result.flip, command.maxFlip);
  hold("flip_hdr", result.flipHdr, command.maxFlipHdr);
  hold("band_rms", kPercent * clean.band.rms, command.maxBand);
  return status;
}

}  // namespace importon
