#include "app/stats_file.h"

#include <nlohmann/json.hpp>

namespace importon {
namespace {

using Json = nlohmann::ordered_json;

Json secondsJson(const PhaseSeconds& seconds) {
  return {{"total", seconds.total},
          {"load", seconds.load},
          {"bvh", seconds.bvh},
          {"device", seconds.device},
          {"importance", seconds.importance},
          {"photons", seconds.photons},
          {"gather", seconds.gather},
          {"output", seconds.output}};
}

Json kernelsJson(const std::vector<KernelStats>& kernels) {
  Json rows = Json::array();
  for (const KernelStats& kernel : kernels) {
    rows.push_back({{"label", kernel.label}, {"launches", kernel.launches}, {"total_ms", kernel.milliseconds}});
  }
  return rows;
}

Json mapJson(const PhotonMapStats& map) {
  return {{"emitted", map.emitted},    {"hits", map.hits},
          {"stored", map.stored},      {"redistributed", map.redistributed},
          {"flux_hits", map.fluxHits}, {"flux_map", map.fluxMap}};
}

Json errorJson(const ErrorStats& error) {
  Json known = Json::object();
  if (error.estimated) known["estimated"] = *error.estimated;
  if (error.low) known["low"] = *error.low;
  if (error.high) known["high"] = *error.high;
  if (error.relmse) known["relmse"] = *error.relmse;
  if (error.relmseTrimmed) known["relmse_trimmed"] = *error.relmseTrimmed;
  if (error.smape) known["smape"] = *error.smape;
  for (const ErrorPoint& point : error.passes) {
    known["passes"].push_back({{"pass", point.pass},
                               {"seconds", point.seconds},
                               {"relmse", point.relmse},
                               {"relmse_trimmed", point.relmseTrimmed},
                               {"smape", point.smape}});
  }
  return known;
}

Json warningsJson(std::span<const Warning> warnings) {
  Json rows = Json::array();
  for (const Warning& warning : warnings) {
    rows.push_back({{"kind", warning.kind}, {"count", warning.count}, {"message", warning.message}});
  }
  return rows;
}

}  // namespace

std::string statsJson(const RenderJob& job, const RenderStats& stats, std::span<const Warning> warnings) {
  Json root;
  root["version"] = IMPORTON_VERSION;
  root["command"] = job.commandLine;
  root["seed"] = job.seed;
  root["device"] = {{"name", stats.deviceName}, {"driver", stats.deviceDriver}, {"type", stats.deviceType}};
  root["scene"] = {{"file", job.scene.string()},
                   {"triangles", stats.triangles},
                   {"lights", stats.lights},
                   {"features", stats.features}};
  root["gather_from"] = stats.gatherFrom;
  root["image"] = {{"width", stats.width}, {"height", stats.height}, {"passes", stats.passes}};
  root["seconds"] = secondsJson(stats.seconds);
  root["kernels"] = kernelsJson(stats.kernels);
  root["rays"] = {{"closest", stats.closestRays}, {"shadow", stats.shadowRays}};
  root["importons"] = {
      {"emitted", stats.importonsEmitted}, {"caustic", stats.importonsCaustic}, {"global", stats.importonsGlobal}};
  root["photons"] = {{"emitted", stats.photonsEmitted},
                     {"pilot", stats.photonsPilot},
                     {"caustic", mapJson(stats.caustic)},
                     {"global", mapJson(stats.global)}};
  root["memory"] = {{"device_peak_bytes", stats.devicePeakBytes},
                    {"photon_map_bytes", stats.photonMapBytes},
                    {"host_peak_bytes", stats.hostPeakBytes}};
  root["error"] = errorJson(stats.error);
  root["warnings"] = warningsJson(warnings);
  // A file name need not be UTF-8, JSON must be.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace importon
