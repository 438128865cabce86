#include "render/device/kernel_set.h"

#include <algorithm>

#include "base/parallel.h"
#include "kernels/add_counter.h"
#include "kernels/cell_add.h"
#include "kernels/cell_claim.h"
#include "kernels/cell_find.h"
#include "kernels/cell_group.h"
#include "kernels/cell_settle.h"
#include "kernels/cell_smooth.h"
#include "kernels/compact_count.h"
#include "kernels/compact_scatter.h"
#include "kernels/eye_light.h"
#include "kernels/film_add.h"
#include "kernels/flux_sum.h"
#include "kernels/grid_cells.h"
#include "kernels/grid_points.h"
#include "kernels/guide_learn.h"
#include "kernels/hit_count.h"
#include "kernels/importon_bound.h"
#include "kernels/importon_count.h"
#include "kernels/importon_density.h"
#include "kernels/importon_entries.h"
#include "kernels/importon_key.h"
#include "kernels/importon_level.h"
#include "kernels/importon_points.h"
#include "kernels/importon_resolve.h"
#include "kernels/irradiance_add.h"
#include "kernels/map_lookup.h"
#include "kernels/photon_key.h"
#include "kernels/photon_resolve.h"
#include "kernels/photon_store.h"
#include "kernels/record_select.h"
#include "kernels/scatter_learn.h"
#include "kernels/set_counter.h"
#include "kernels/site_emit.h"
#include "kernels/sort_count.h"
#include "kernels/sort_scatter.h"
#include "render/device/kernel_variants.h"
#include "shared/render_data.h"

namespace importon {
namespace {

// Enough for some tens of workgroups on the threads of a CPU, and for all threads that a large GPU runs at once.
constexpr std::uint32_t kTraceInvocationsOnCpu = 1u << 11;
constexpr std::uint32_t kTraceInvocationsOnGpu = 1u << 18;

using Getter = const gpu::Kernel& (*)(KernelSet&);
using Getters = std::vector<Getter>;

template <class... Calls>
void add(Getters& to) {
  (to.push_back([](KernelSet& set) -> const gpu::Kernel& { return set.get<Calls>(); }), ...);
}

uint boundOf(const RenderJob& job) {
  if (job.importance == ImportanceChoice::map) return kBoundNone;
  return job.differentialBound == DifferentialBound::pixel ? kBoundPixel : kBoundScreen;
}

void addTracing(Getters& to, const FeatureSet& features) {
  using namespace kernels;
  add<SetCounter>(to);
  features.hasAlpha ? add<TraceClosestAlpha>(to) : add<TraceClosest>(to);
  add<CompactCount, OneScan, CompactScatter, AddCounter>(to);
  if (features.hasPanes) return add<TraceShadowPanes>(to);
  features.hasAlpha ? add<TraceShadowAlpha>(to) : add<TraceShadow>(to);
}

void addImportance(Getters& to, const RenderJob& job) {
  using namespace kernels;
  add<ImportonEmit, ImportonScatter, RecordSelect, ImportonCount, ImportonLevel, ImportonEntries, ImportonPoints,
      SortCount, SortScatter, GridCells, GridPoints, ImportonDensity, ImportonKey, ImportonResolve>(to);
  if (job.importance == ImportanceChoice::differentials) add<ImportonFootprint, ImportonBound>(to);
}

/// What default settings surely call for, in the order of use.
Getters listAhead(const FeatureSet& features, const RenderJob& job) {
  using namespace kernels;
  Getters list;
  addTracing(list, features);
  if (job.integrator == Integrator::photon) {
    addImportance(list, job);
    if (job.scatter == ScatterChoice::guided) add<PhotonScatterGuided, SiteEmit, ScatterLearn>(list);
    add<PhotonEmitByPower, PhotonScatter, GuideLearn, PhotonEmitGuided, HitCount, IrradianceAdd, CellGroup, CellSmooth>(
        list);
    if (features.needsCausticMap || !features.readsCells)
      add<CausticScatter, kernels::MapLookup, CellFind, CellClaim, CellSettle, CellAdd, PhotonKey, PhotonStore,
          PhotonResolve, FluxSum>(list);
  }
  add<EyeScatter, EyeEmit, EyeLight, FilmAdd>(list);
  return list;
}

}  // namespace

bool KernelSet::hasPanes() const {
  const auto panes = std::ranges::find(constants_, kSpecHasPanes, &gpu::Specialization::id);
  return panes != constants_.end() && panes->value != 0;
}

const gpu::Kernel& KernelSet::find(std::string_view label, const gpu::KernelCode& code,
                                   std::optional<gpu::Specialization> own) {
  const std::scoped_lock lock(mutex_);
  const Key key = own ? Key(&code, own->id, own->value) : Key(&code, kNone, 0);
  const auto found = found_.find(key);
  if (found != found_.end()) return *found->second;
  std::vector<gpu::Specialization> constants = constants_;
  if (own) {
    std::erase_if(constants, [&](const gpu::Specialization& s) { return s.id == own->id; });
    constants.push_back(*own);
  }
  return *found_.emplace(key, &cache_->find(label, code, constants)).first->second;
}

std::vector<gpu::Specialization> constantsOf(const FeatureSet& features, const RenderJob& job, bool isCpu) {
  std::vector<gpu::Specialization> constants = specializations(features);
  constants.push_back({kSpecTraceInvocations, isCpu ? kTraceInvocationsOnCpu : kTraceInvocationsOnGpu});
  constants.push_back({kSpecDispatchWorkgroup, job.workgroupSize});
  constants.push_back({kSpecWorkgroupSize, job.workgroupSize});
  constants.push_back({kSpecEyeMode, job.integrator == Integrator::path ? kEyePath : kEyeImage});
  constants.push_back({kSpecImportanceBound, boundOf(job)});
  constants.push_back({kSpecIsDirectional, job.requiredBy == RequiredBy::direction});
  return constants;
}

void compileAhead(KernelSet& set, const FeatureSet& features, const RenderJob& job) {
  const Getters list = listAhead(features, job);
  parallelFor(list.size(), 1, job.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) list[i](set).compile();
  });
}

}  // namespace importon
