/// A camera that goes around.
#pragma once
#include "scene/scene.h"

namespace importon {

/// A point of the vertical axis, in the world, that the camera goes around: the middle of the scene for our own camera.
/// Another one goes around what is in the middle of its image: the solid or surface there, as far away as the middle of
/// the solid; meshes that stand in many places count as boxes. Where it sees nothing there, around the point on its
/// line of sight that is nearest to the middle of the scene, or that middle where it looks away.
[[nodiscard]] glm::dvec3 turntableCentre(const Scene& scene, const Camera& camera);

/// The camera after so many turns around the vertical axis through `centre`, counter-clockwise from above. After whole
/// turns it is the same to the last bit.
[[nodiscard]] Camera turnedAround(const Camera& camera, const glm::dvec3& centre, double turns);

}  // namespace importon
