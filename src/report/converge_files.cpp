#include "report/converge_files.h"

#include <nlohmann/json.hpp>

#include "fmt/format.h"
#include "io/png.h"
#include "io/tone_map.h"
#include "report/false_color.h"
#include "report/flip.h"
#include "report/page.h"

namespace importon {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPercent = 100;

Json optionalJson(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json intervalJson(const Interval& interval) {
  return {{"mean", interval.mean}, {"low", optionalJson(interval.low)}, {"high", optionalJson(interval.high)}};
}

Json pointJson(const ConvergePoint& point) {
  return {{"budget", point.budget},
          {"seconds", point.seconds},
          {"passes", point.passes},
          {"photons_emitted", point.photonsEmitted},
          {"photons_stored", point.photonsStored},
          {"relmse", point.errors.relmse},
          {"relmse_trimmed", point.errors.relmseTrimmed},
          {"smape", point.errors.smape},
          {"rmse", point.errors.rmse},
          {"mean_ratio", point.errors.meanRatio},
          {"band_rms", kPercent * point.band.rms},
          {"band_p99", kPercent * point.band.p99}};
}

Json runJson(const ConvergeRun& run) {
  Json points = Json::array();
  for (const ConvergePoint& point : run.points) points.push_back(pointJson(point));
  return {{"seed", run.seed},
          {"device_peak_bytes", run.devicePeakBytes},
          {"photon_map_bytes", run.photonMapBytes},
          {"points", std::move(points)}};
}

Json summaryJson(const ConvergeSummary& summary) {
  Json json{{"budget", summary.budget},
            {"seconds", intervalJson(summary.seconds)},
            {"relmse_trimmed", intervalJson(summary.error)},
            {"squared_bias", nullptr},
            {"variance", nullptr}};
  if (summary.parts) {
    json["squared_bias"] = summary.parts->squaredBias;
    json["variance"] = summary.parts->variance;
  }
  return json;
}

Json resultJson(const ConvergeResult& result, const std::vector<double>& levels) {
  Json runs = Json::array(), summaries = Json::array(), times = Json::array();
  for (const ConvergeRun& run : result.runs) runs.push_back(runJson(run));
  for (const ConvergeSummary& summary : result.summaries) summaries.push_back(summaryJson(summary));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    times.push_back({{"relmse_trimmed", levels[i]},
                     {"seconds", result.timeToError[i] ? intervalJson(*result.timeToError[i]) : Json(nullptr)}});
  }
  return {{"name", result.config.name},
          {"options", result.config.options},
          {"runs", std::move(runs)},
          {"summary", std::move(summaries)},
          {"time_to_error", std::move(times)}};
}

Json reportJson(const ConvergeTitle& title, const ConvergeReport& report) {
  Json configs = Json::array();
  for (const ConvergeResult& result : report.results) configs.push_back(resultJson(result, report.levels));
  return {{"version", title.version},
          {"scene", title.scene},
          {"reference", title.reference},
          {"reference_error", optionalJson(title.referenceError)},
          {"device", {{"name", report.deviceName}, {"driver", report.deviceDriver}}},
          {"seeds", title.seeds},
          {"budgets", title.budgets},
          {"levels", report.levels},
          {"configs", std::move(configs)}};
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string convergeJson(const ConvergeTitle& title, const ConvergeReport& report) {
  return dumped(reportJson(title, report), 2) + "\n";
}

std::string convergeCsv(const ConvergeReport& report) {
  std::string text =
      "config,seed,budget,seconds,passes,photons_emitted,photons_stored,device_peak_bytes,photon_map_bytes,relmse,"
      "relmse_trimmed,smape,rmse,mean_ratio,band_rms,band_p99\n";
  for (const ConvergeResult& result : report.results) {
    for (const ConvergeRun& run : result.runs) {
      for (const ConvergePoint& point : run.points) {
        text += fmt::format("{},{},{},{:.6g},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                            result.config.name, run.seed, point.budget, point.seconds, point.passes,
                            point.photonsEmitted, point.photonsStored, run.devicePeakBytes, run.photonMapBytes,
                            point.errors.relmse, point.errors.relmseTrimmed, point.errors.smape, point.errors.rmse,
                            point.errors.meanRatio, kPercent * point.band.rms, kPercent * point.band.p99);
      }
    }
  }
  return text;
}

std::string convergePage(const ConvergeTitle& title, const ConvergeReport& report, const Image& reference) {
  Json data = reportJson(title, report);
  const float exposure = autoExposure(reference, title.reference);
  const ShownImage truth = toneMapped(reference, exposure, title.reference);
  const Look look = report.results.empty() ? Look{} : report.results.front().config.job.look;
  const float shownExposure = exposureOf(look, reference, title.reference);
  const auto addImage = [&](const std::string& name, const Image& image) {
    const PngPixels error =
        falseColors(image.width, image.height, ldrFlipMap(toneMapped(image, exposure, name), truth));
    data["images"].push_back({{"name", name},
                              {"image", dataUri(shownPixels(image, shownExposure, look.toneMap, name))},
                              {"error", dataUri(error)}});
  };
  addImage("reference", reference);
  for (const ConvergeResult& result : report.results) {
    if (!result.image.channels.empty()) addImage(result.config.name, result.image);
  }
  return fillPage(kConvergePage, dumped(data, -1));
}

}  // namespace importon
