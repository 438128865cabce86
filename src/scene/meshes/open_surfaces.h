/// Which surfaces of a mesh enclose a solid, and which are sheets.
#pragma once
#include <vector>

#include "scene/meshes/gltf_mesh.h"

namespace importon {

/// Sets MeshPart::isOpen of those parts of one mesh whose hasVolume is true, in the order of `parts`, and that enclose
/// nothing; one of which some triangles do and others do not becomes two parts.
///
/// Triangles of all parts count, their corners joined where they are at one place, to a millionth of the mesh's size.
/// A triangle with an edge that no other has is open, but around small holes, of up to 1/500 of their surface, and so
/// is what has such an edge once it is taken away. What is left is closed; it is open all the same where it encloses no
/// space (a pane of two sides at one place), or where less than half of it has a volume (a window in the wall of a
/// room).
void splitOpenSurfaces(std::vector<MeshPart>& parts, const std::vector<bool>& hasVolume);

}  // namespace importon
