// The irradiance map of a render in progress.
#include <bit>
#include <cmath>

#include "render/photon_pass.h"
#include "render/render_session.h"
#include "shared/bindings.h"

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

PointDensity RenderSession::densityOfRecords(float scale, bool isFlux) const {
  const uint count = work_->counters.download<uint>(1, kCounterRecords * sizeof(uint)).front();
  const auto points = work_->recordPoints.download<MapPoint>(count);
  const auto records = work_->records.download<Record>(count);
  std::vector<vec3> positions;
  std::vector<float> weights;
  for (std::size_t i = 0; i < count; ++i) {
    if ((records[i].kind & kRecordGlobal) == 0) continue;
    positions.push_back(points[i].position);
    weights.push_back(scale * (isFlux ? records[i].flux.x : 1.0f));
  }
  return PointDensity(positions, weights, parameters_.gridOrigin, parameters_.gridExtent);
}

void RenderSession::findCellSizes() {
  startPass(0);
  const std::uint32_t pilot = std::min({plan_.batch, plan_.whole.photons, kPilotPhotons});
  if (pilot > 0) tracePilot({MapKind::global, nullptr, true}, 0, pilot);
  recorder_->submitAndWait();
  const float perPass = static_cast<float>(plan_.whole.photons) / static_cast<float>(std::max(pilot, 1u));
  cellSizes_->hits = densityOfRecords(perPass, false);
}

void RenderSession::cutCells(int generation) {
  const double floor = static_cast<double>(parameters_.globalMap.densityFloor) / kFloorPhotonsPerCell;
  const double constant = static_cast<double>(parameters_.globalMap.constantDensity);
  const double growth = std::exp2(generation);  // as required density grows: the cube root of the passes
  const auto density = [&](vec3 position) {
    if (constant > 0) return constant * growth;
    const double required = cellSizes_->importance.at(position) * static_cast<double>(parameters_.globalMap.photonsPerPixel);
    return growth * std::max(floor, std::min(required, cellSizes_->hits->at(position) / kHitsPerCell));
  };
  // Room for all passes of the generation; units as fine as that allows, for the light of weak lamps beside strong ones.
  parameters_.irradianceUnits = parameters_.fluxScale / std::ldexp(1.0f, 3 * (generation + 1));
  irradiance_.reset();  // its memory is needed
  parameters_.photonUnits = photonUnits(parameters_, plan_.whole.photons);
  irradiance_.emplace(device_->context, cutSurfaces(scene_, density, plan_.mostCells, job_.threads),
                      parameters_.irradianceUnits, firstPassOf(generation));
}

void RenderSession::prepareCells(int pass) {
  const int generation = generationOf(pass);
  if (!irradiance_ || irradiance_->firstPass() != firstPassOf(generation)) cutCells(generation);
  parameters_.irradianceScale = irradiance_->scale(pass) / parameters_.photonUnits;
  irradiance_->bind(work_->table, pass);
}

}  // namespace importon
