#include "report/study_files.h"

#include <nlohmann/json.hpp>

#include "report/false_color.h"
#include "report/page.h"
#include "report/study_pictures.h"

namespace importon {
namespace {

using Json = nlohmann::ordered_json;

Json mapJson(const PhotonMapStats& map) {
  return {{"hits", map.hits},
          {"stored", map.stored},
          {"redistributed", map.redistributed},
          {"flux_hits", map.fluxHits},
          {"flux_map", map.fluxMap}};
}

/// Mean over the pixels that show something, of a layer's values.
double meanOf(const Image& image, const std::string& layer) {
  const Channel* channel = image.find(layer + ".Y");
  if (channel == nullptr) return 0;
  double sum = 0, count = 0;
  for (const float value : channel->values) {
    if (!(value > 0)) continue;
    sum += static_cast<double>(value);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

Json densityJson(const Image& image, const std::string& map) {
  Json json;
  for (const char* layer : {"importance", "required", "density"})
    json[layer] = meanOf(image, std::string(layer) + "." + map);
  return json;
}

Json resultJson(const StudyResult& result) {
  const RenderStats& stats = result.stats;
  return {
      {"name", result.config.name},
      {"options", result.config.options},
      {"passes", stats.passes},
      {"seconds",
       {{"total", stats.seconds.total},
        {"importance", stats.seconds.importance},
        {"photons", stats.seconds.photons},
        {"gather", stats.seconds.gather}}},
      {"importons",
       {{"emitted", stats.importonsEmitted}, {"caustic", stats.importonsCaustic}, {"global", stats.importonsGlobal}}},
      {"photons",
       {{"emitted", stats.photonsEmitted}, {"caustic", mapJson(stats.caustic)}, {"global", mapJson(stats.global)}}},
      {"mean_where_seen",
       {{"caustic", densityJson(result.image, "caustic")}, {"global", densityJson(result.image, "global")}}},
      {"photon_map_bytes", stats.photonMapBytes},
      {"against_first",
       {{"relmse", result.againstFirst.relmse},
        {"relmse_trimmed", result.againstFirst.relmseTrimmed},
        {"smape", result.againstFirst.smape},
        {"mean_ratio", result.againstFirst.meanRatio},
        {"flip", result.againstFirst.flip}}}};
}

Json reportJson(const StudyTitle& title, const StudyReport& report) {
  Json json{{"version", title.version}, {"scene", title.scene}};
  if (!report.results.empty()) {
    const RenderStats& stats = report.results.front().stats;
    json["device"] = {{"name", stats.deviceName}, {"driver", stats.deviceDriver}};
    json["image"] = {{"width", stats.width}, {"height", stats.height}};
  }
  json["configs"] = Json::array();
  for (const StudyResult& result : report.results) json["configs"].push_back(resultJson(result));
  return json;
}

Json figureJson(const StudyFigure& figure) {
  Json pictures = Json::array();
  for (const StudyPicture& picture : figure.pictures)
    pictures.push_back({{"name", picture.name}, {"image", dataUri(picture.pixels)}});
  return {{"title", figure.title}, {"text", figure.text}, {"unit", figure.unit},
          {"low", figure.low},     {"high", figure.high}, {"pictures", std::move(pictures)}};
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string studyJson(const StudyTitle& title, const StudyReport& report) {
  return dumped(reportJson(title, report), 2) + "\n";
}

std::string studyPage(const StudyTitle& title, const StudyReport& report) {
  Json data = reportJson(title, report);
  data["figures"] = Json::array();
  for (const StudyFigure& figure : studyFigures(report)) data["figures"].push_back(figureJson(figure));
  data["colors"] = Json::array();
  constexpr int kStops = 16;
  for (int i = 0; i <= kStops; ++i) {
    const auto [r, g, b] = falseColor(static_cast<float>(i) / kStops);
    data["colors"].push_back({r, g, b});
  }
  return fillPage(kStudyPage, dumped(data, -1));
}

}  // namespace importon
