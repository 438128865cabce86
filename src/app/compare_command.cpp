#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "fmt/format.h"
#include "io/image.h"
#include "report/compare.h"

namespace importon {
namespace {

std::string asText(const Comparison& result) {
  std::string text = fmt::format(
      "relmse          {:.6g}\nrelmse_trimmed  {:.6g}\nsmape           {:.6g}\nrmse            {:.6g}\n"
      "mean_ratio      {:.6g}\nflip            {:.6g} (LDR-FLIP, tone-mapped by the reference)\n",
      result.relmse, result.relmseTrimmed, result.smape, result.rmse, result.meanRatio, result.flip);
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
                                    {"non_finite_pixels", result.nonFinitePixels}};
  return json.dump(2) + "\n";
}

}  // namespace

ExitStatus runCompare(const CompareCommand& command) {
  const Image image = readExr(command.image), reference = readExr(command.reference);
  const Comparison result =
      compareImages(image, command.image.string(), reference, command.reference.string(), command.floor);
  std::fputs((command.isJson ? asJson(result) : asText(result)).c_str(), stdout);
  ExitStatus status = ExitStatus::ok;
  const auto hold = [&](const char* name, double value, std::optional<double> limit) {
    if (!limit || value <= *limit) return;
    std::fprintf(stderr, "importon: %s %g is above the limit %g\n", name, value, *limit);
    status = ExitStatus::limitExceeded;
  };
  hold("relmse", result.relmse, command.maxRelmse);
  hold("flip", result.flip, command.maxFlip);
  return status;
}

}  // namespace importon
