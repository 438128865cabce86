#include "render/surface_cache/irradiance_map.h"

#include "kernels/cell_group.h"
#include "kernels/cell_smooth.h"
#include "kernels/irradiance_add.h"

namespace importon {

using gpu::TexelFormat;

namespace {

constexpr std::size_t kBytesPerGroup = 64;  // two sides: shaders/bindings/cell_groups.glsl
constexpr std::size_t kWordsPerSide =
    8;  // six of flux, photons, squares: shaders/kernels/surface_cache/irradiance_add.comp

/// A buffer of at least one element.
template <class T>
gpu::Buffer makeTexels(gpu::Context& context, const char* name, std::span<const T> values, TexelFormat format) {
  static constexpr T kNothing{};
  return gpu::makeBuffer(context, name, values.empty() ? std::span<const T>(&kNothing, 1) : values, format);
}

std::uint64_t wordPair(std::span<const uint> words, std::size_t at) {
  return words[at] | std::uint64_t{words[at + 1]} << 32;
}

}  // namespace

IrradianceMap::IrradianceMap(gpu::Context& context, const SurfaceCells& cells, float units, int firstPass)
    : IrradianceMap(context, cells, growCellTree(cells), units, firstPass) {}

IrradianceMap::IrradianceMap(gpu::Context& context, const SurfaceCells& cells, const CellTree& tree, float units,
                             int firstPass)
    : units_(units),
      firstPass_(firstPass),
      levels_(tree.levels),
      groups_(makeTexels(context, "cell groups", std::span<const uvec4>(tree.groups), TexelFormat::uint4)),
      members_(makeTexels(context, "cell members", std::span<const uint>(tree.members), TexelFormat::uint1)),
      places_(makeTexels(context, "cell places", std::span<const uvec2>(tree.cells), TexelFormat::uint2)),
      groupLight_(context, "light on cell groups", kBytesPerGroup * std::max<std::size_t>(tree.groups.size(), 1),
                  TexelFormat::uint4),
      irradiance_(context, "irradiance of cells", 2 * sizeof(uvec4) * cells.areas.size(), TexelFormat::uint4),
      tables_{makeTexels(context, "surface cells", std::span<const uvec2>(cells.triangles), TexelFormat::uint2),
              makeTexels(context, "cells of placed meshes", std::span<const uvec2>(cells.placed), TexelFormat::uint2)},
      totals_(gpu::makeZeros(context, "irradiance totals", 6 * sizeof(uint))) {
  for (gpu::Buffer& half : halves_)
    half = gpu::makeZeros(context, "irradiance", 2 * kWordsPerSide * sizeof(uint) * cells.areas.size(),
                          TexelFormat::uint4);
}

void IrradianceMap::smooth(const Stage& stage) const {
  const buffers::GroupLight light{groupLight_};
  const buffers::CellGroups groups{groups_};
  const buffers::CellMembers members{members_};
  const auto cellCount = static_cast<uint>(places_.bytes() / sizeof(uvec2));
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
    const uint count = levels_[level + 1] - levels_[level];
    run<kernels::CellGroup>(stage, 2 * count, {.first = levels_[level], .count = count, .cells = cellCount}, groups,
                            members, light);
  }
  run<kernels::CellSmooth>(stage, 2 * cellCount, {.cells = cellCount}, groups, members, light);
}

void IrradianceMap::addBatch(const Stage& stage) const {
  overTiles<kernels::IrradianceAdd>(stage, kCounterRecords, {}, buffers::Totals{totals_});
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

std::uint64_t IrradianceMap::bytes() const {
  std::uint64_t bytes = 0;
  for (const gpu::Buffer* buffer : {&tables_.triangles, &tables_.placed, &halves_[0], &halves_[1], &groups_, &members_,
                                    &places_, &groupLight_, &irradiance_, &totals_})
    bytes += buffer->allocatedBytes();
  return bytes;
}

}  // namespace importon
