#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "fmt/format.h"
#include "io/image.h"
#include "io/layers.h"
#include "report/compare.h"
#include "report/false_color.h"

namespace importon {
namespace {

std::string asText(const Comparison& result) {
  std::string text = fmt::format(
      "relmse          {:.6g}\nrelmse_trimmed  {:.6g}\nsmape           {:.6g}\nrmse            {:.6g}\n"
      "mean_ratio      {:.6g}\nflip            {:.6g} (LDR-FLIP, tone-mapped by the reference)\n"
      "flip_hdr        {:.6g} (HDR-FLIP)\n",
      result.relmse, result.relmseTrimmed, result.smape, result.rmse, result.meanRatio, result.flip, result.flipHdr);
  if (result.nonFinitePixels > 0) text += fmt::format("non-finite pixels: {}\n", result.nonFinitePixels);
  return text;
}

/// What is infinite becomes null.
std::string asJson(const Comparison& result) {
  const nlohmann::ordered_json json{{"relmse", result.relmse},
                                    {"relmse_trimmed", result.relmseTrimmed},
                                    {"smape", result.smape},
                                    {"rmse", result.rmse},
                                    {"mean_ratio", result.meanRatio},
                                    {"flip", result.flip},
                                    {"flip_kind", "LDR-FLIP, tone-mapped by the reference"},
                                    {"flip_hdr", result.flipHdr},
                                    {"non_finite_pixels", result.nonFinitePixels}};
  return json.dump(2) + "\n";
}

Image readColor(const std::filesystem::path& file, const std::string& layer) {
  return takeColor(readExr(file), layer, file.string());
}

}  // namespace

ExitStatus runCompare(const CompareCommand& command) {
  for (const std::filesystem::path& file : {command.diff, command.diffPng}) {
    if (!file.empty()) checkWritable(file);
  }
  const Image image = readColor(command.image, command.layer);
  const Image reference = readColor(command.reference, command.referenceLayer);
  const std::string imageName = command.image.string(), referenceName = command.reference.string();
  ErrorMaps maps;
  const Comparison result = compareImages(image, imageName, reference, referenceName, command.floor, &maps);
  if (!command.diff.empty()) {
    writeExr(command.diff, differenceImage(image, imageName, reference, referenceName, maps));
  }
  if (!command.diffPng.empty()) writePng(command.diffPng, falseColors(image.width, image.height, maps.flip));
  std::fputs((command.isJson ? asJson(result) : asText(result)).c_str(), stdout);
  ExitStatus status = ExitStatus::ok;
  const auto hold = [&](const char* name, double value, std::optional<double> limit) {
    if (!limit || value <= *limit) return;
    std::fprintf(stderr, "importon: %s %g is above the limit %g\n", name, value, *limit);
    status = ExitStatus::limitExceeded;
  };
  hold("relmse", result.relmse, command.maxRelmse);
  hold("flip", result.flip, command.maxFlip);
  hold("flip_hdr", result.flipHdr, command.maxFlipHdr);
  return status;
}

}  // namespace importon
