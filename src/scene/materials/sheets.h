/// Materials of open surfaces.
#pragma once
#include <span>

#include "scene/geometry.h"
#include "scene/materials/gltf_material.h"

namespace importon {

/// Gives instances of open parts (MeshPart::isOpen) the material of a sheet: as their own, but no solid, and as thick
/// as thicknessFactor in the mesh's space is in the world, by the cube root of the change of volume. The instances have
/// their materials of `set`, which grows by what it lacks.
void useSheets(std::span<MeshInstance> instances, MaterialSet& set);

}  // namespace importon
