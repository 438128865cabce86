#include "render/irradiance_map.h"

#include <bit>

#include "shared/bindings.h"
#include "shared/push_data.h"

namespace importon {

using gpu::TexelFormat;

namespace {

constexpr std::size_t kWordsPerSide = 8;  // six of flux, photons, area: shaders/bindings/irradiance.glsl

std::vector<uint> emptySides(const SurfaceCells& cells) {
  std::vector<uint> words(2 * kWordsPerSide * cells.areas.size());
  for (std::size_t i = 0; i < 2 * cells.areas.size(); ++i)
    words[kWordsPerSide * i + 7] = std::bit_cast<uint>(cells.areas[i / 2]);
  return words;
}

std::uint64_t wordPair(std::span<const uint> words, std::size_t at) {
  return words[at] | std::uint64_t{words[at + 1]} << 32;
}

}  // namespace

IrradianceMap::IrradianceMap(gpu::Context& context, const SurfaceCells& cells, std::uint64_t batchHits, float units,
                             int firstPass)
    : units_(units),
      firstPass_(firstPass),
      surface_(gpu::makeBuffer(context, "surface cells", std::span<const uvec2>(cells.triangles), TexelFormat::uint2)),
      recordCells_(context, "cells of hits", batchHits * sizeof(uvec2)),
      totals_(gpu::makeBuffer(context, "irradiance totals", std::span<const uint>(std::vector<uint>(6)))) {
  const std::vector<uint> empty = emptySides(cells);
  for (gpu::Buffer& half : halves_)
    half = gpu::makeBuffer(context, "irradiance", std::span<const uint>(empty), TexelFormat::uint4);
}

void IrradianceMap::bind(gpu::BindingTable& table, int pass) const {
  table.set(kBindingSurfaceCells, surface_);
  table.set(kBindingRecordCells, recordCells_);
  table.set(kBindingIrradiance, halves_[half(pass)]);
  table.set(kBindingIrradianceTexels, halves_[half(pass)]);
}

void IrradianceMap::addBatch(const Stage& stage) const {
  gpu::BindingTable table = stage.work.table;
  table.set(kBindingTotals, totals_);
  overTiles(stage, stage.kernels.irradianceAdd, table, kCounterRecords);
}

std::vector<gpu::Buffer*> IrradianceMap::memory() { return {&halves_[0], &halves_[1], &totals_}; }

PhotonMapCounts IrradianceMap::readFlux() const {
  PhotonMapCounts counts;
  const auto totals = totals_.download<uint>(6);
  std::array<std::uint64_t, 3> inCells{};
  for (const gpu::Buffer& half : halves_) {
    const auto words = half.download<uint>(half.bytes() / sizeof(uint));
    for (std::size_t at = 0; at < words.size(); at += kWordsPerSide)
      for (std::size_t c = 0; c < 3; ++c) inCells[c] += wordPair(words, at + 2 * c);
  }
  const double unit = 1 / (static_cast<double>(units_) * std::max(passes_, 1));
  for (std::size_t c = 0; c < 3; ++c) {
    counts.fluxHits[c] = static_cast<double>(wordPair(totals, 2 * c)) * unit;
    counts.fluxMap[c] = static_cast<double>(inCells[c]) * unit;
    counts.isEnergyExact = counts.isEnergyExact && wordPair(totals, 2 * c) == inCells[c];
  }
  return counts;
}

std::uint64_t IrradianceMap::bytes() const { return surface_.bytes() + halves_[0].bytes() + halves_[1].bytes(); }

}  // namespace importon
