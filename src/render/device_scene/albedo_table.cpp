#include "render/device_scene/albedo_table.h"

namespace importon {
namespace {

constexpr uint kTable[] = {
#include "albedo_table.inc"  // made by make_albedo_table.cpp
};
static_assert(std::size(kTable) == kAlbedoTexels);

}  // namespace

std::span<const uint> albedoTable() { return kTable; }

}  // namespace importon
