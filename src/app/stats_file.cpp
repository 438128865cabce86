#include "app/stats_file.h"

#include <nlohmann/json.hpp>

namespace importon {
namespace {

using Json = nlohmann::ordered_json;

Json kernelsJson(const std::vector<KernelStats>& kernels) {
  Json rows = Json::array();
  for (const KernelStats& kernel : kernels) {
    rows.push_back({{"label", kernel.label},
                    {"launches", kernel.launches},
                    {"total_ms", kernel.milliseconds},
                    {"compile_ms", kernel.compileMilliseconds}});
  }
  return rows;
}

Json errorJson(const ErrorStats& error) {
  Json known = Json::object();
  if (error.estimated) known["estimated"] = *error.estimated;
  if (error.low) known["low"] = *error.low;
  if (error.high) known["high"] = *error.high;
  if (error.relmse) known["relmse"] = *error.relmse;
  if (error.relmseTrimmed) known["relmse_trimmed"] = *error.relmseTrimmed;
  if (error.smape) known["smape"] = *error.smape;
  if (error.band) known["band"] = *error.band;
  for (const ErrorPoint& point : error.passes) {
    known["passes"].push_back({{"pass", point.pass},
                               {"seconds", point.seconds},
                               {"relmse", point.relmse},
                               {"relmse_trimmed", point.relmseTrimmed},
                               {"smape", point.smape}});
  }
  return known;
}

Json devicesJson(const std::vector<DeviceStats>& devices) {
  Json rows = Json::array();
  for (const DeviceStats& device : devices) {
    rows.push_back({{"name", device.name},
                    {"driver", device.driver},
                    {"type", device.type},
                    {"seed", device.seed},
                    {"passes", device.passes},
                    {"photons_emitted", device.photonsEmitted},
                    {"device_peak_bytes", device.peakBytes}});
  }
  return rows;
}

Json warningsJson(std::span<const Warning> warnings) {
  Json rows = Json::array();
  for (const Warning& warning : warnings) {
    rows.push_back({{"kind", warning.kind}, {"count", warning.count}, {"message", warning.message}});
  }
  return rows;
}

/// A statistic: where it stands in the file, as a JSON pointer, and its value.
struct StatRow {
  const char* place;
  Json (*read)(const RenderStats&);
};

template <auto kMember>
Json of(const RenderStats& stats) {
  return stats.*kMember;
}
template <auto kPart, auto kMember>
Json of(const RenderStats& stats) {
  return (stats.*kPart).*kMember;
}

using S = RenderStats;
using Seconds = PhaseSeconds;
using Map = PhotonMapStats;

constexpr StatRow kRows[] = {{"/device/name", of<&S::deviceName>},
                             {"/device/driver", of<&S::deviceDriver>},
                             {"/device/type", of<&S::deviceType>},
                             {"/devices", [](const S& stats) { return devicesJson(stats.devices); }},
                             {"/scene/triangles", of<&S::triangles>},
                             {"/scene/lights", of<&S::lights>},
                             {"/scene/features", of<&S::features>},
                             {"/light", of<&S::light>},
                             {"/gather_from", of<&S::gatherFrom>},
                             {"/image/width", of<&S::width>},
                             {"/image/height", of<&S::height>},
                             {"/image/passes", of<&S::passes>},
                             {"/seconds/total", of<&S::seconds, &Seconds::total>},
                             {"/seconds/load", of<&S::seconds, &Seconds::load>},
                             {"/seconds/bvh", of<&S::seconds, &Seconds::bvh>},
                             {"/seconds/device", of<&S::seconds, &Seconds::device>},
                             {"/seconds/importance", of<&S::seconds, &Seconds::importance>},
                             {"/seconds/cells", of<&S::seconds, &Seconds::cells>},
                             {"/seconds/photons", of<&S::seconds, &Seconds::photons>},
                             {"/seconds/gather", of<&S::seconds, &Seconds::gather>},
                             {"/seconds/resolve", of<&S::seconds, &Seconds::resolve>},
                             {"/seconds/output", of<&S::seconds, &Seconds::output>},
                             {"/kernels", [](const S& stats) { return kernelsJson(stats.kernels); }},
                             {"/rays/closest", of<&S::closestRays>},
                             {"/rays/shadow", of<&S::shadowRays>},
                             {"/importons/emitted", of<&S::importonsEmitted>},
                             {"/importons/caustic", of<&S::importonsCaustic>},
                             {"/importons/global", of<&S::importonsGlobal>},
                             {"/photons/emitted", of<&S::photonsEmitted>},
                             {"/photons/pilot", of<&S::photonsPilot>},
                             {"/photons/caustic/emitted", of<&S::caustic, &Map::emitted>},
                             {"/photons/caustic/hits", of<&S::caustic, &Map::hits>},
                             {"/photons/caustic/stored", of<&S::caustic, &Map::stored>},
                             {"/photons/caustic/redistributed", of<&S::caustic, &Map::redistributed>},
                             {"/photons/caustic/flux_hits", of<&S::caustic, &Map::fluxHits>},
                             {"/photons/caustic/flux_map", of<&S::caustic, &Map::fluxMap>},
                             {"/photons/global/emitted", of<&S::global, &Map::emitted>},
                             {"/photons/global/hits", of<&S::global, &Map::hits>},
                             {"/photons/global/stored", of<&S::global, &Map::stored>},
                             {"/photons/global/redistributed", of<&S::global, &Map::redistributed>},
                             {"/photons/global/flux_hits", of<&S::global, &Map::fluxHits>},
                             {"/photons/global/flux_map", of<&S::global, &Map::fluxMap>},
                             {"/memory/device_peak_bytes", of<&S::devicePeakBytes>},
                             {"/memory/photon_map_bytes", of<&S::photonMapBytes>},
                             {"/memory/host_peak_bytes", of<&S::hostPeakBytes>},
                             {"/error", [](const S& stats) { return errorJson(stats.error); }}};

}  // namespace

Json statsTree(const RenderJob& job, const RenderStats& stats, std::span<const Warning> warnings) {
  Json root{{"seed", job.seed}, {"device", {}}, {"scene", {{"file", job.scene.string()}}}};
  for (const StatRow& row : kRows) root[Json::json_pointer(row.place)] = row.read(stats);
  root["warnings"] = warningsJson(warnings);
  return root;
}

std::string statsJson(const RenderJob& job, const RenderStats& stats, std::span<const Warning> warnings) {
  Json root{{"version", IMPORTON_VERSION}, {"command", job.commandLine}};
  root.update(statsTree(job, stats, warnings));
  return jsonText(root);
}

std::string jsonText(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace importon
