/// The light of a photographer's studio, for models that bring none: docs/studio.md.
#pragma once
#include "scene/scene.h"

namespace importon {

/// Soft boxes over a gradient as a lat-long map, W/(m² sr), the same in all channels. Fixed to the world: +y is up, the
/// key light stands to the upper left of who looks along -z.
[[nodiscard]] EnvironmentMap studioEnvironment();

/// True if nothing but emissive triangles lights the scene, and so weakly that the picture would be black: a grey
/// surface (18 %) that saw nothing but the brightest of them, all around, would stay below the first step of an 8-bit
/// sRGB picture above black, at exposure 1. True without any light.
[[nodiscard]] bool isAsGoodAsUnlit(const Scene& scene);

/// True for a file without camera where nothing but emissive triangles gives light: a model with parts that glow, not a
/// scene that they are to light.
[[nodiscard]] bool isGlowingModel(const Scene& scene);

/// What lights the scene: "studio", or "scene", which is also an environment given for it.
[[nodiscard]] inline const char* lightName(const Scene& scene) { return scene.isInStudio ? "studio" : "scene"; }

}  // namespace importon
