#include "render/kernel_set.h"

#include "base/parallel.h"
#include "kernels/registry.h"
#include "shared/features.h"
#include "shared/render_data.h"

namespace importon {
namespace {

// Enough for some tens of workgroups on the threads of a CPU, and for all threads that a large GPU runs at once.
constexpr std::uint32_t kTraceInvocationsOnCpu = 1u << 11;
constexpr std::uint32_t kTraceInvocationsOnGpu = 1u << 18;

struct Entry {
  gpu::Kernel* kernel;
  const char* label;
  const char* module;
  std::vector<gpu::Specialization> extra;
};

std::vector<Entry> listCommon(KernelSet& k, Integrator integrator, bool hasAlpha) {
  const char* trace = hasAlpha ? "trace_alpha" : "trace";
  const uint mode = integrator == Integrator::path ? kEyePath : kEyeImage;
  return {{&k.setCounter, "set counter", "set_counter", {}},
          {&k.addCounter, "add counter", "add_counter", {}},
          {&k.compactCount, "compact count", "compact_count", {}},
          {&k.scan, "scan", "scan", {{kSpecWorkgroupSize, kScanThreads}}},
          {&k.compactScatter, "compact scatter", "compact_scatter", {}},
          {&k.traceClosest, "trace closest", trace, {{kSpecAnyHit, 0}}},
          {&k.traceShadow, "trace shadow", trace, {{kSpecAnyHit, 1}}},
          {&k.eyeEmit, "camera rays", "eye_emit", {{kSpecEyeMode, mode}}},
          {&k.eyeScatter, "shade camera path", "eye_scatter", {{kSpecEyeMode, mode}}},
          {&k.eyeLight, "add direct light", "eye_light", {}},
          {&k.filmAdd, "film", "film_add", {}},
          {&k.aovSurface, "AOV surface", "aov_surface", {}}};
}

uint boundOf(const RenderJob& job) {
  if (job.importance == ImportanceChoice::map) return kBoundNone;
  return job.differentialBound == DifferentialBound::pixel ? kBoundPixel : kBoundScreen;
}

std::vector<Entry> listDifferentials(KernelSet& k, const RenderJob& job) {
  return {{&k.importonDifferential, "importon footprint", "importon_differential", {{kSpecEyeMode, kEyeImportons}}},
          {&k.importonBound, "importance bound", "importon_bound", {{kSpecImportanceBound, boundOf(job)}}}};
}

std::vector<Entry> listScatterGuide(KernelSet& k) {
  return {{&k.photonScatterGuided, "scatter guided photon", "photon_scatter",
           {{kSpecPhotonKind, kPhotonsGlobal}, {kSpecScatterIsGuided, 1}}},
          {&k.siteEmit, "importance leaves sites", "site_emit", {}},
          {&k.scatterLearn, "learn scattering", "scatter_learn", {}}};
}

std::vector<Entry> listMaps(KernelSet& k, const RenderJob& job) {
  return {{&k.sortCount, "sort count", "sort_count", {}},
          {&k.sortScatter, "sort scatter", "sort_scatter", {}},
          {&k.gridCells, "grid cells", "grid_cells", {}},
          {&k.gridPoints, "grid points", "grid_points", {}},
          {&k.mapLookup, "map lookup", "map_lookup", {}},
          {&k.mapIrradiance, "read irradiance", "map_irradiance", {}},
          {&k.irradianceEstimate, "irradiance", "irradiance_estimate", {}},
          {&k.mapNearest, "nearest photons", "map_nearest", {}},
          {&k.aovAsk, "AOV asks map", "aov_ask", {}},
          {&k.aovAnswer, "AOV map light", "aov_answer", {}},
          {&k.photonEntries, "photon entries", "photon_entries", {}},
          {&k.photonEntryPoints, "photon entry points", "photon_entry_points", {}},
          {&k.aovMap, "AOV map", "aov_map", {}},
          {&k.importonEmit, "importon rays", "eye_emit", {{kSpecEyeMode, kEyeImportons}}},
          {&k.importonScatter, "scatter importon", "eye_scatter", {{kSpecEyeMode, kEyeImportons}}},
          {&k.importonCount, "importon count", "importon_count", {}},
          {&k.importonLevel, "importon level", "importon_level", {}},
          {&k.importonEntries, "importon entries", "importon_entries", {}},
          {&k.importonPoints, "importon points", "importon_points", {}},
          {&k.importonDensity, "importance", "importon_density", {{kSpecImportanceBound, boundOf(job)}}},
          {&k.importonKey, "importon key", "importon_key", {}},
          {&k.importonResolve, "importance in order", "importon_resolve", {}},
          {&k.photonEmit, "photon rays", "photon_emit", {{kSpecIsGuided, 0}}},
          {&k.photonEmitGuided, "guided photon rays", "photon_emit", {{kSpecIsGuided, 1}}},
          {&k.photonScatter, "scatter photon", "photon_scatter", {{kSpecPhotonKind, kPhotonsGlobal}}},
          {&k.causticScatter, "scatter caustic photon", "photon_scatter", {{kSpecPhotonKind, kPhotonsCaustic}}},
          {&k.guideLearn, "learn guide", "guide_learn", {}},
          {&k.siteAsk, "ask of sites", "site_ask", {}},
          {&k.irradianceAdd, "add to irradiance", "irradiance_add", {}},
          {&k.aovCells, "AOV cells", "aov_cells", {}},
          {&k.recordSelect, "select records", "record_select", {}},
          {&k.hitCount, "count hits", "hit_count", {}},
          {&k.hitKey, "required density", "hit_key", {}},
          {&k.photonQuota, "density quota", "photon_quota", {}},
          {&k.photonStore, "store photons", "photon_store", {}},
          {&k.pilotCount, "count pilot", "pilot_count", {}},
          {&k.photonThin, "thin photons", "photon_thin", {}},
          {&k.photonKey, "photon key", "photon_key", {}},
          {&k.cellFind, "find cell", "cell_find", {{kSpecIsDirectional, job.requiredBy == RequiredBy::direction}}},
          {&k.cellClaim, "claim cell", "cell_claim", {}},
          {&k.cellSettle, "settle cell", "cell_settle", {}},
          {&k.cellAdd, "add to cell", "cell_add", {}},
          {&k.cellClear, "clear cells", "cell_clear", {}},
          {&k.photonRedistribute, "redistribute power", "photon_redistribute", {}},
          {&k.photonResolve, "resolve map", "photon_resolve", {}},
          {&k.fluxSum, "sum flux", "flux_sum", {}}};
}

}  // namespace

KernelSet makeKernels(gpu::Context& context, const FeatureSet& features, const RenderJob& job) {
  KernelSet set;
  std::vector<Entry> entries = listCommon(set, job.integrator, features.hasAlpha);
  if (job.integrator == Integrator::photon) {
    for (Entry& entry : listMaps(set, job)) entries.push_back(std::move(entry));
    if (job.importance == ImportanceChoice::differentials)
      for (Entry& entry : listDifferentials(set, job)) entries.push_back(std::move(entry));
    if (job.scatter == ScatterChoice::guided)
      for (Entry& entry : listScatterGuide(set)) entries.push_back(std::move(entry));
  }
  std::vector<gpu::Specialization> common = specializations(features);
  common.push_back({kSpecTraceInvocations, context.limits().isCpu ? kTraceInvocationsOnCpu : kTraceInvocationsOnGpu});
  common.push_back({kSpecDispatchWorkgroup, job.workgroupSize});
  parallelFor(entries.size(), 1, job.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<gpu::Specialization> all = common;
      all.insert(all.end(), entries[i].extra.begin(), entries[i].extra.end());
      if (entries[i].kernel != &set.scan) all.push_back({kSpecWorkgroupSize, job.workgroupSize});
      *entries[i].kernel = gpu::Kernel(context, entries[i].label, kernels::spirv(entries[i].module), all);
    }
  });
  return set;
}

}  // namespace importon
