/// What solids are filled with.
#pragma once
#include <vector>

#include "base/log.h"
#include "scene/scene.h"

namespace importon {

/// `materials` with their media numbered, as shaders/lib/path.glsl asks for: solids of equal index, dispersion and
/// absorption are of one medium. Of more than kMostMedia, those beyond take the one that is nearest to their own.
/// Panes are marked, too.
[[nodiscard]] std::vector<Material> withMedia(std::vector<Material> materials);

/// Warns of more media than kMostMedia.
void warnOfMedia(const std::vector<Material>& materials, Log& log);

}  // namespace importon
