#include "render/surface_cache/surface_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/photons/pilots.h"

namespace importon {
namespace {

constexpr std::uint32_t kPilotPhotons = 1u << 14;  // show where photons fall
constexpr double kFloorPhotonsPerCell = 2;         // of the density floor, for the largest cells
constexpr double kHitsPerCell = 0.75;              // of a pass, at least, on average

/// The map is cut anew, finer, at pass 7, 63, 511, ...: the photons before count for an eighth of those that follow.
int generationOf(int pass) { return (std::bit_width(static_cast<unsigned>(pass + 1)) - 1) / 3; }
int firstPassOf(int generation) { return (1 << (3 * generation)) - 1; }

/// Squared flux of an average photon is then 16: a cell's sum holds some 10^8 of them.
float photonUnits(const Parameters& parameters, std::uint32_t photons) {
  const double flux = static_cast<double>(parameters.totalPower) * static_cast<double>(parameters.irradianceUnits);
  return flux > 0 ? static_cast<float>(4.0 * std::max(photons, 1u) / flux) : 1;
}

}  // namespace

/// How densely the records for the global map lie: each counts `scale`, or as many times its flux.
PointDensity SurfaceCache::densityOfRecords(float scale, bool isFlux) const {
  const uint count = readCounter(context_.stage(), kCounterRecords);
  const auto points = context_.work.recordPoints.download<MapPoint>(count);
  const auto records = context_.work.records.download<Record>(count);
  std::vector<vec3> positions;
  std::vector<float> weights;
  for (std::size_t i = 0; i < count; ++i) {
    if ((records[i].kind & kRecordGlobal) == 0) continue;
    positions.push_back(points[i].position);
    weights.push_back(scale * (isFlux ? records[i].flux.x : 1.0f));
  }
  return PointDensity(positions, weights, context_.parameters.gridOrigin, context_.parameters.gridExtent);
}

void SurfaceCache::learnImportance() {
  if (context_.features.readsCells) importance_ = densityOfRecords(1, true);
}

void SurfaceCache::learnHits() {
  if (!context_.features.readsCells) return;
  context_.beginPilot();
  const std::uint32_t pilot = std::min({context_.plan.batch, context_.plan.whole.photons, kPilotPhotons});
  if (pilot > 0) tracePilot(context_, {MapKind::global, nullptr, true}, 0, pilot);
  context_.recorder.submitAndWait();
  hits_ = densityOfRecords(static_cast<float>(context_.plan.whole.photons) / static_cast<float>(std::max(pilot, 1u)),
                           false);
}

void SurfaceCache::cut(int generation) {
  Parameters& parameters = context_.parameters;
  const double floor = static_cast<double>(parameters.globalMap.densityFloor) / kFloorPhotonsPerCell;
  const double constant = static_cast<double>(parameters.globalMap.constantDensity);
  const double growth = std::exp2(generation);  // as required density grows: the cube root of the passes
  const auto density = [&](vec3 position) {
    if (constant > 0) return constant * growth;
    const double required = importance_->at(position) * static_cast<double>(parameters.globalMap.photonsPerPixel);
    return growth * std::max(floor, std::min(required, hits_->at(position) / kHitsPerCell));
  };
  // Room for all passes of the generation; units as fine as that allows, for the light of weak lamps beside strong
  // ones.
  parameters.irradianceUnits = parameters.fluxScale / std::ldexp(1.0f, 3 * (generation + 1));
  irradiance_.reset();  // its memory is needed
  parameters.photonUnits = photonUnits(parameters, context_.plan.whole.photons);
  irradiance_.emplace(context_.device->context,
                      cutSurfaces(context_.scene, density, context_.plan.mostCells, context_.job.threads),
                      parameters.irradianceUnits, firstPassOf(generation));
}

void SurfaceCache::beginPass(int pass) {
  const int generation = generationOf(pass);
  if (!irradiance_ || irradiance_->firstPass() != firstPassOf(generation)) cut(generation);
  context_.parameters.irradianceScale = irradiance_->scale(pass) / context_.parameters.photonUnits;
  context_.work.cells = irradiance_->cells(pass);
}

void SurfaceCache::count(std::span<const uint> counters, PhotonMapStats& stats) const {
  const std::uint64_t hits = sumOf(counters, kSumCellHits);
  stats.hits += hits;
  stats.stored += counters[kCounterCellsLit];
  stats.redistributed += hits - counters[kCounterCellsLit];
}

void SurfaceCache::prepareFor(int passes) {
  beginPass(std::max(passes - 1, 0));
  irradiance_->setPasses(passes);
}

void SurfaceCache::addKept(std::vector<Kept>& state) {
  if (!irradiance_) return;
  const std::vector<gpu::Buffer*> memory = irradiance_->memory();
  for (std::size_t i = 0; i < memory.size(); ++i) state.push_back(keep(fmt::format("surface cache {}", i), *memory[i]));
}

}  // namespace importon
