#include "render/gather_source.h"

#include <array>

namespace importon {
namespace {

struct PhotonOption {
  std::string_view text;
  bool (*isGiven)(const RenderJob&);
};

constexpr std::array kPhotonOptions{
    PhotonOption{"--control off", [](const RenderJob& job) { return job.control == DensityControl::off; }},
    PhotonOption{"--control probability",
                 [](const RenderJob& job) { return job.control == DensityControl::probability; }},
    PhotonOption{"--redistribute", [](const RenderJob& job) { return job.redistribute.has_value(); }},
    PhotonOption{"--lookup", [](const RenderJob& job) { return job.lookup.has_value(); }},
    PhotonOption{"--irradiance", [](const RenderJob& job) { return job.irradiance != IrradianceCache::off; }},
    PhotonOption{"--importance differentials",
                 [](const RenderJob& job) { return job.importance == ImportanceChoice::differentials; }}};

}  // namespace

std::string_view photonReason(const RenderJob& job) {
  for (const PhotonOption& option : kPhotonOptions)
    if (option.isGiven(job)) return option.text;
  return {};
}

GatherSource gatherSource(const RenderJob& job) {
  if (!photonReason(job).empty()) return GatherSource::photons;
  // The number of photons of a lookup is of use to the caustic map alone, too: it implies photons, but does not need them.
  return job.gatherFrom.value_or(job.lookupPhotons ? GatherSource::photons : GatherSource::cells);
}

std::string_view gatherSourceName(const RenderJob& job) {
  if (job.integrator == Integrator::path) return "none";
  return gatherSource(job) == GatherSource::cells ? "cells" : "photons";
}

}  // namespace importon
