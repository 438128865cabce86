/// A camera for scenes that bring none.
#pragma once
#include "scene/scene.h"

namespace importon {

/// A perspective camera that shows all triangles in an image of that aspect ratio (width over height), as large as fits
/// with a margin of a tenth: in a three-quarter view, from the front (+z), the right and above, with +y up. What faces
/// one way, as a quad or the ground does, is seen from that side and not edge-on.
[[nodiscard]] Camera framingCamera(const Scene& scene, double aspect);

/// One that looks from the same side at the vertical axis through the middle of the scene, and from as far away as
/// shows all triangles from wherever it goes around that axis.
[[nodiscard]] Camera roundFramingCamera(const Scene& scene, double aspect);

}  // namespace importon
