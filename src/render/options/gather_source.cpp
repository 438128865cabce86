#include "render/options/gather_source.h"

#include "render/options/option_table.h"

namespace importon {

std::string photonReason(const RenderJob& job) {
  for (const OptionRow& row : optionTable())
    if (row.impliesPhotons != nullptr && row.impliesPhotons(job)) return row.name() + " " + row.value(job);
  return {};
}

GatherSource gatherSource(const RenderJob& job) {
  if (!photonReason(job).empty()) return GatherSource::photons;
  // The number of photons of a lookup is of use to the caustic map alone, too: it implies photons, but does not need
  // them.
  return job.gatherFrom.value_or(job.lookupPhotons ? GatherSource::photons : GatherSource::cells);
}

std::string_view gatherSourceName(const RenderJob& job) {
  if (job.integrator == Integrator::path) return "none";
  return gatherSource(job) == GatherSource::cells ? "cells" : "photons";
}

}  // namespace importon
