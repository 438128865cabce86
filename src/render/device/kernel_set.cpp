#include "render/device/kernel_set.h"

#include "base/parallel.h"
#include "fmt/format.h"
#include "kernels/registry.h"
#include "shared/features.h"
#include "shared/render_data.h"

namespace importon {
namespace {

// Enough for some tens of workgroups on the threads of a CPU, and for all threads that a large GPU runs at once.
constexpr std::uint32_t kTraceInvocationsOnCpu = 1u << 11;
constexpr std::uint32_t kTraceInvocationsOnGpu = 1u << 18;

struct Entry {
  gpu::Kernel KernelSet::*kernel;
  const char* label;
  const char* module;
  std::vector<gpu::Specialization> extra;
};

using Entries = std::vector<Entry>;

Entries listTracing(bool hasAlpha) {
  const char* trace = hasAlpha ? "trace_alpha" : "trace";
  return {{&KernelSet::setCounter, "set counter", "set_counter", {}},
          {&KernelSet::traceClosest, "trace closest", trace, {{kSpecAnyHit, 0}}},
          {&KernelSet::compactCount, "compact count", "compact_count", {}},
          {&KernelSet::scan, "scan", "scan", {{kSpecWorkgroupSize, kScanThreads}}},
          {&KernelSet::compactScatter, "compact scatter", "compact_scatter", {}},
          {&KernelSet::addCounter, "add counter", "add_counter", {}},
          {&KernelSet::traceShadow, "trace shadow", trace, {{kSpecAnyHit, 1}}}};
}

Entries listEye(Integrator integrator) {
  const uint mode = integrator == Integrator::path ? kEyePath : kEyeImage;
  return {{&KernelSet::eyeScatter, "shade camera path", "eye_scatter", {{kSpecEyeMode, mode}}},
          {&KernelSet::eyeEmit, "camera rays", "eye_emit", {{kSpecEyeMode, mode}}},
          {&KernelSet::eyeLight, "add direct light", "eye_light", {}},
          {&KernelSet::filmAdd, "film", "film_add", {}}};
}

uint boundOf(const RenderJob& job) {
  if (job.importance == ImportanceChoice::map) return kBoundNone;
  return job.differentialBound == DifferentialBound::pixel ? kBoundPixel : kBoundScreen;
}

Entries listDifferentials(const RenderJob& job) {
  return {{&KernelSet::importonDifferential,
           "importon footprint",
           "importon_differential",
           {{kSpecEyeMode, kEyeImportons}}},
          {&KernelSet::importonBound, "importance bound", "importon_bound", {{kSpecImportanceBound, boundOf(job)}}}};
}

Entries listScatterGuide() {
  return {{&KernelSet::photonScatterGuided,
           "scatter guided photon",
           "photon_scatter",
           {{kSpecPhotonKind, kPhotonsGlobal}, {kSpecScatterIsGuided, 1}}},
          {&KernelSet::siteEmit, "importance leaves sites", "site_emit", {}},
          {&KernelSet::scatterLearn, "learn scattering", "scatter_learn", {}}};
}

Entries listImportons(const RenderJob& job) {
  return {{&KernelSet::importonEmit, "importon rays", "eye_emit", {{kSpecEyeMode, kEyeImportons}}},
          {&KernelSet::importonScatter, "scatter importon", "eye_scatter", {{kSpecEyeMode, kEyeImportons}}},
          {&KernelSet::recordSelect, "select records", "record_select", {}},
          {&KernelSet::importonCount, "importon count", "importon_count", {}},
          {&KernelSet::importonLevel, "importon level", "importon_level", {}},
          {&KernelSet::importonEntries, "importon entries", "importon_entries", {}},
          {&KernelSet::importonPoints, "importon points", "importon_points", {}},
          {&KernelSet::sortCount, "sort count", "sort_count", {}},
          {&KernelSet::sortScatter, "sort scatter", "sort_scatter", {}},
          {&KernelSet::gridCells, "grid cells", "grid_cells", {}},
          {&KernelSet::gridPoints, "grid points", "grid_points", {}},
          {&KernelSet::importonDensity, "importance", "importon_density", {{kSpecImportanceBound, boundOf(job)}}},
          {&KernelSet::importonKey, "importon key", "importon_key", {}},
          {&KernelSet::importonResolve, "importance in order", "importon_resolve", {}}};
}

Entries listPhotons() {
  return {{&KernelSet::photonEmit, "photon rays", "photon_emit", {{kSpecIsGuided, 0}}},
          {&KernelSet::photonScatter, "scatter photon", "photon_scatter", {{kSpecPhotonKind, kPhotonsGlobal}}},
          {&KernelSet::guideLearn, "learn guide", "guide_learn", {}},
          {&KernelSet::photonEmitGuided, "guided photon rays", "photon_emit", {{kSpecIsGuided, 1}}},
          {&KernelSet::hitCount, "count hits", "hit_count", {}},
          {&KernelSet::irradianceAdd, "add to irradiance", "irradiance_add", {}},
          {&KernelSet::cellGroup, "light of cell groups", "cell_group", {}},
          {&KernelSet::cellSmooth, "irradiance of cells", "cell_smooth", {}}};
}

/// Photons kept in a map, their density controlled by cells.
Entries listMap(const RenderJob& job) {
  return {
      {&KernelSet::causticScatter, "scatter caustic photon", "photon_scatter", {{kSpecPhotonKind, kPhotonsCaustic}}},
      {&KernelSet::mapLookup, "map lookup", "map_lookup", {}},
      {&KernelSet::cellFind, "find cell", "cell_find", {{kSpecIsDirectional, job.requiredBy == RequiredBy::direction}}},
      {&KernelSet::cellClaim, "claim cell", "cell_claim", {}},
      {&KernelSet::cellSettle, "settle cell", "cell_settle", {}},
      {&KernelSet::cellAdd, "add to cell", "cell_add", {}},
      {&KernelSet::cellMove, "move cells", "cell_move", {}},
      {&KernelSet::photonKey, "photon key", "photon_key", {}},
      {&KernelSet::photonStore, "store photons", "photon_store", {}},
      {&KernelSet::photonResolve, "resolve map", "photon_resolve", {}},
      {&KernelSet::fluxSum, "sum flux", "flux_sum", {}}};
}

/// What only chosen settings or layers call for.
Entries listChoices() {
  return {{&KernelSet::hitKey, "required density", "hit_key", {}},
          {&KernelSet::photonQuota, "density quota", "photon_quota", {}},
          {&KernelSet::photonRedistribute, "redistribute power", "photon_redistribute", {}},
          {&KernelSet::pilotCount, "count pilot", "pilot_count", {}},
          {&KernelSet::photonThin, "thin photons", "photon_thin", {}},
          {&KernelSet::mapIrradiance, "read irradiance", "map_irradiance", {}},
          {&KernelSet::irradianceEstimate, "irradiance", "irradiance_estimate", {}},
          {&KernelSet::mapNearest, "nearest photons", "map_nearest", {}},
          {&KernelSet::photonEntries, "photon entries", "photon_entries", {}},
          {&KernelSet::photonEntryPoints, "photon entry points", "photon_entry_points", {}},
          {&KernelSet::siteAsk, "ask of sites", "site_ask", {}},
          {&KernelSet::aovAsk, "AOV asks map", "aov_ask", {}},
          {&KernelSet::aovAnswer, "AOV map light", "aov_answer", {}},
          {&KernelSet::aovMap, "AOV map", "aov_map", {}},
          {&KernelSet::aovCells, "AOV cells", "aov_cells", {}}};
}

/// All that the job may call for, that which default settings surely call for first and in the order of use.
struct Lists {
  Entries ahead, others;
};

Lists listAll(const FeatureSet& features, const RenderJob& job) {
  Lists lists{listTracing(features.hasAlpha), {{&KernelSet::aovSurface, "AOV surface", "aov_surface", {}}}};
  const auto add = [](Entries& to, const Entries& from) { to.insert(to.end(), from.begin(), from.end()); };
  if (job.integrator == Integrator::photon) {
    add(lists.ahead, listImportons(job));
    if (job.importance == ImportanceChoice::differentials) add(lists.ahead, listDifferentials(job));
    if (job.scatter == ScatterChoice::guided) add(lists.ahead, listScatterGuide());
    add(lists.ahead, listPhotons());
    add(features.needsCausticMap || !features.readsCells ? lists.ahead : lists.others, listMap(job));
    add(lists.others, listChoices());
  }
  add(lists.ahead, listEye(job.integrator));
  return lists;
}

}  // namespace

KernelSet makeKernels(gpu::Context& context, const FeatureSet& features, const RenderJob& job) {
  std::vector<gpu::Specialization> common = specializations(features);
  common.push_back({kSpecTraceInvocations, context.limits().isCpu ? kTraceInvocationsOnCpu : kTraceInvocationsOnGpu});
  common.push_back({kSpecDispatchWorkgroup, job.workgroupSize});
  KernelSet set;
  const Lists lists = listAll(features, job);
  for (const Entries* entries : {&lists.ahead, &lists.others})
    for (const Entry& entry : *entries) {
      std::vector<gpu::Specialization> all = common;
      all.insert(all.end(), entry.extra.begin(), entry.extra.end());
      if (entry.kernel != &KernelSet::scan) all.push_back({kSpecWorkgroupSize, job.workgroupSize});
      set.*entry.kernel = gpu::Kernel(context, entry.label, kernels::spirv(entry.module), all);
    }
  return set;
}

void compileAhead(const KernelSet& set, const FeatureSet& features, const RenderJob& job) {
  const Entries entries = listAll(features, job).ahead;
  parallelFor(entries.size(), 1, job.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) (set.*entries[i].kernel).compile();
  });
}

std::string describeKernels(const FeatureSet& features, const RenderJob& job) {
  std::string text = fmt::format("workgroups of {}", job.workgroupSize);
  const auto add = [&text](const std::vector<gpu::Specialization>& constants) {
    for (const gpu::Specialization& constant : constants) text += fmt::format(" {}={}", constant.id, constant.value);
  };
  add(specializations(features));
  const Lists lists = listAll(features, job);
  for (const Entries* entries : {&lists.ahead, &lists.others})
    for (const Entry& entry : *entries) {
      text += fmt::format("; {}", entry.module);
      add(entry.extra);
    }
  return text;
}

}  // namespace importon
