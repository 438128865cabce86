#include "app/batch/batch_summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/stats_file.h"

namespace importon {
namespace {

using Json = nlohmann::ordered_json;

Json textOrNull(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json resultJson(const BatchResult& result) {
  const RenderJob& job = result.job;
  Json json{{"scene", job.scene.string()},
            {"camera", textOrNull(result.camera)},
            {"output", job.output.string()},
            {"png", textOrNull(job.png.string())},
            {"status", static_cast<int>(result.status)},
            {"error", textOrNull(result.error)},
            {"seconds", result.seconds},
            {"stats", result.stats ? statsTree(job, *result.stats, result.warnings) : Json()}};
  if (job.frame) json["frame"] = *job.frame;
  return json;
}

}  // namespace

ExitStatus worstStatus(const std::vector<BatchResult>& results) {
  ExitStatus worst = ExitStatus::ok;
  for (const BatchResult& result : results) worst = std::max(worst, result.status);
  return worst;
}

std::string summaryJson(const BatchCommand& command, const std::vector<BatchResult>& results, double seconds) {
  Json root{{"version", IMPORTON_VERSION},
            {"command", command.commandLine},
            {"status", static_cast<int>(worstStatus(results))},
            {"seconds", seconds},
            {"pictures", std::ranges::count_if(results, [](const BatchResult& r) { return r.stats.has_value(); })}};
  root["jobs"] = Json::array();
  for (const BatchResult& result : results) root["jobs"].push_back(resultJson(result));
  return jsonText(root);
}

}  // namespace importon
