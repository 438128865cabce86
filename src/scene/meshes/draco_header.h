/// The sizes that Draco data declare.
#pragma once
#include <span>
#include <string>

namespace importon {

/// Holds what a Draco stream declares against what it has: libdraco allocates that much before it decodes. Throws
/// SceneError at `where` if it is no mesh, declares more than 2^26 triangles or points, or more than 1024 for each
/// byte, which is twice what a plane of two million triangles needs if a coordinate has one bit.
void checkDracoHeader(std::span<const unsigned char> stream, const std::string& where);

}  // namespace importon
